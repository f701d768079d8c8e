#include "base/config/Schema.h"

#include "base/config/Configuration.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace scanloom::schema_unittest
{
namespace
{
struct CellOptions
{
  double cell_size = 0.1;
  int neighbours = 7;
  bool fine = false;
  std::string label = "";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.cell_size, Field{"cell_size", "m", "edge of a cell", above(0)});
    visit(o.neighbours, Field{"neighbours", "", "1 | 7 | 27", Bounds{0, 27, true}});
    visit(o.fine, Field{"fine", "", "align twice"});
    visit(o.label, Field{"label", "", "name in the report"});
  }
};

struct CellSettings
{
  CellOptions cells;
  CellOptions others;

  template <typename Self, typename Visitor>
  static void sections(Self& s, Visitor&& visit)
  {
    visit(s.cells, Section{"cells", "of the map"});
    visit(s.others, Section{"cells", "of the map", "other_"});
  }
};

TEST(Schema, writesEveryDefaultWithItsMeaningUnitAndBounds)
{
  EXPECT_EQ(toIni({describe<CellOptions>(Section{"cells", "of the map"})}),
            "# of the map\n"
            "[cells]\n"
            "# edge of a cell [m], > 0\n"
            "cell_size = 0.1\n"
            "# 1 | 7 | 27, whole number, > 0 and <= 27\n"
            "neighbours = 7\n"
            "# align twice, true or false\n"
            "fine = false\n"
            "# name in the report\n"
            "label =\n");
}

TEST(Schema, writesAFileThatIsReadBackAsTheSameValues)
{
  CellSettings settings;
  settings.cells.cell_size = 1.0 / 3.0;
  settings.others.label = "left lidar";
  settings.others.fine = true;

  const std::string written = toIni(schemaOf(settings));
  const auto read = readSettings<CellSettings>(Configuration::fromText(written, "default"), schemaOf<CellSettings>());

  EXPECT_EQ(read.cells.cell_size, settings.cells.cell_size);
  EXPECT_EQ(read.others.label, "left lidar");
  EXPECT_TRUE(read.others.fine);
  EXPECT_EQ(toIni(schemaOf(read)), written);
}

TEST(Schema, writesATableForEachSection)
{
  EXPECT_EQ(toMarkdown({describe<CellOptions>(Section{"cells", "of the map"})}),
            "## [cells]\n"
            "of the map\n\n"
            "| key | default | meaning |\n"
            "|---|---|---|\n"
            "| `cell_size` | 0.1 | edge of a cell [m], > 0 |\n"
            "| `neighbours` | 7 | 1 \\| 7 \\| 27, whole number, > 0 and <= 27 |\n"
            "| `fine` | false | align twice, true or false |\n"
            "| `label` |  | name in the report |\n");
}

TEST(Schema, refusesADefaultOutOfItsOwnBounds)
{
  CellSettings wrong;
  wrong.cells.cell_size = std::numeric_limits<double>::infinity();
  EXPECT_THROW(schemaOf(wrong), std::logic_error);
  wrong.cells.cell_size = 0;
  EXPECT_THROW(schemaOf(wrong), std::logic_error);
}

TEST(Schema, holdsASectionOnceForSeveralVerbs)
{
  Schema schema = schemaOf<CellSettings>();
  merge(schema, schemaOf<CellSettings>());

  ASSERT_EQ(schema.size(), 1U);
  EXPECT_EQ(schema[0].fields.size(), 8U);
}

TEST(Schema, refusesTwoDeclarationsOfAKeyThatDiffer)
{
  CellSettings other_default;
  other_default.cells.neighbours = 1;
  Schema schema = schemaOf<CellSettings>();

  EXPECT_THROW(merge(schema, schemaOf(other_default)), std::logic_error);
}
}  // namespace
}  // namespace scanloom::schema_unittest
