#include "lab/study/Gnuplot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "lab/study/StudyRecords.h"
#include "lab/study/internal/StudyFigures.h"
#include "support/TemporaryFolder.h"

namespace scanloom::gnuplot_unittest
{
namespace
{
using testing::HasSubstr;

const Quantity kDrift{"drift [m]", [](const RunRecord& record) { return std::optional(record.figures->drift); }};

TEST(GnuplotString, isInSingleQuotesWhichAreDoubledWithinIt)
{
  EXPECT_EQ(gnuplotString("left, N = 1"), "'left, N = 1'");
  EXPECT_EQ(gnuplotString("it's"), "'it''s'");
  EXPECT_EQ(gnuplotString("'quoted'"), "' ''quoted'''");
}

TEST(GnuplotString, refusesTextThatCannotBeShown)
{
  EXPECT_THROW(gnuplotString("a\nsystem('touch x')"), std::invalid_argument);
  EXPECT_THROW(gnuplotString(std::string(1, '\0')), std::invalid_argument);
  EXPECT_THROW(gnuplotString("\xff"), std::invalid_argument);
}

/** Text of a stranger's results.json is shown in a figure, whatever it is: no program runs. */
TEST(Gnuplot, takesNoTextForAProgram)
{
  const TemporaryFolder folder;
  const std::filesystem::path mark = folder / "ran";
  for (const std::string& program :
       {"`touch " + mark.string() + "`", "\"; system(\"touch " + mark.string() + "\"); \"",
        "'; system('touch " + mark.string() + "'); '", "$(touch " + mark.string() + ") %s %% @x {/Bold x} \\n"})
  {
    std::vector<RunRecord> records{runWithDrift(1, program)};
    records[0].run.settings = {{program, program}};
    const std::vector<StudyCell> cells = cellsOf(records);
    EXPECT_THAT(Gnuplot(folder.path()).draw(barsScript(barsOf(cells, kDrift), program)), HasSubstr("<svg")) << program;
    EXPECT_THAT(Gnuplot(folder.path()).draw(driftOverDistanceScript(cells)), HasSubstr("<svg")) << program;
    EXPECT_FALSE(std::filesystem::exists(mark)) << program;
  }
}

TEST(Gnuplot, drawsIntoAFolderOfAnyName)
{
  const TemporaryFolder folder;
  const std::filesystem::path odd = folder / "it's `touch ran` \"x\"";
  std::filesystem::create_directory(odd);
  Gnuplot(odd).drawInto(odd / "figure.svg", "plot x\n");
  EXPECT_GT(std::filesystem::file_size(odd / "figure.svg"), 0U);
}
}  // namespace
}  // namespace scanloom::gnuplot_unittest
