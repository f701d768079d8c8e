/**
 * Whether KISS-ICP and MOLA find what they need in our files. Read here by headers and bytes, without our own readers.
 * KISS-ICP (generic loader): files in the order of their names; x, y, z; the first field of t, timestamp, timestamps,
 * time, stamps. MOLA: observations labelled lidar and imu; of a CGenericPointsMap the fields intensity, t and ring.
 */
#include "mrpt/edit/internal/ExportClouds.h"
#include "smallRawlog.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

namespace scanloom::interoperability_unittest
{
namespace
{
using testing::ElementsAre;

constexpr float kTimeOfColumn1 = 0.002441403F;  // s after the stamp; points 3, 4 and 5 are of it
constexpr std::size_t kPoints = 120, kPoint = 4;

template <typename T>
T at(const std::string& bytes, std::size_t offset)
{
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

struct Field
{
  std::string name, type;
  std::size_t offset;
};

/** Fields without gaps, as both formats lay them out, and where the points begin. */
struct Layout
{
  std::vector<Field> fields;
  std::size_t begin = 0, point_size = 0, points = 0;

  void add(const std::string& name, const std::string& type, std::size_t size)
  {
    fields.push_back({name, type, point_size});
    point_size += size;
  }

  const Field& named(const std::string& name) const
  {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
    if (found == fields.end()) throw std::runtime_error("no field " + name);
    return *found;
  }

  /** As KISS-ICP chooses it. */
  const Field& stamps() const
  {
    for (const char* name : {"t", "timestamp", "timestamps", "time", "stamps"})
      for (const Field& field : fields)
        if (field.name == name) return field;
    throw std::runtime_error("no field of stamps");
  }
};

std::vector<std::string> wordsOf(const std::string& line)
{
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), {}};
}

Layout plyLayout(const std::string& file)
{
  const std::map<std::string, std::size_t> sizes{{"float", 4}, {"double", 8}, {"ushort", 2}, {"uchar", 1}};
  Layout layout;
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line) && line != "end_header";)
  {
    const auto words = wordsOf(line);
    if (words[0] == "format")
    {
      EXPECT_EQ(words[1], "binary_little_endian");
    }
    if (words[0] == "element") layout.points = std::stoul(words[2]);
    if (words[0] == "property") layout.add(words[2], words[1], sizes.at(words[1]));
  }
  layout.begin = static_cast<std::size_t>(lines.tellg());
  return layout;
}

Layout pcdLayout(const std::string& file)
{
  std::map<std::string, std::vector<std::string>> header;
  std::istringstream lines(file);
  for (std::string line; header.count("DATA") == 0 && std::getline(lines, line);)
    if (auto words = wordsOf(line); line[0] != '#')
      header[words.front()] = std::vector<std::string>(words.begin() + 1, words.end());
  EXPECT_THAT(header["DATA"], ElementsAre("binary"));
  EXPECT_EQ(header["WIDTH"], header["POINTS"]);
  EXPECT_THAT(header["COUNT"], testing::Each("1"));
  Layout layout;
  for (std::size_t i = 0; i < header["FIELDS"].size(); ++i)
    layout.add(header["FIELDS"][i], header["TYPE"].at(i) + header["SIZE"].at(i), std::stoul(header["SIZE"].at(i)));
  layout.points = std::stoul(header["POINTS"].at(0));
  layout.begin = static_cast<std::size_t>(lines.tellg());
  return layout;
}

struct Interoperability : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog"), out = folder / "out";

  /** The files that KISS-ICP would take, in its order. */
  std::vector<std::string> exported(CloudFormat format, const std::string& ending, const std::string& below)
  {
    readRawlog(in, exportClouds(format, out, someHeader()), [](std::uint64_t) { return true; });
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(out / below))
      if (entry.path().extension() == ending) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  static void expectPoint(const std::string& file, const Layout& layout, const std::string& type_of_xyz)
  {
    ASSERT_EQ(layout.points, kPoints);
    ASSERT_EQ(file.size(), layout.begin + layout.points * layout.point_size);
    const std::size_t point = layout.begin + kPoint * layout.point_size;
    const std::map<std::string, float> truth{{"x", 0.4F}, {"y", -0.2F}, {"z", 1.0F}, {"intensity", 28.0F}};
    for (const auto& [name, value] : truth)
    {
      EXPECT_EQ(layout.named(name).type, type_of_xyz) << name;
      EXPECT_FLOAT_EQ(at<float>(file, point + layout.named(name).offset), value) << name;
    }
    EXPECT_EQ(at<std::uint16_t>(file, point + layout.named("ring").offset), 1);
  }
};

TEST_F(Interoperability, kissIcpFindsPositionsAndStampsInPly)
{
  EXPECT_THAT(exported(CloudFormat::Ply, ".ply", "lidar"),
              ElementsAre("000000.ply", "000001.ply", "000002.ply", "000003.ply"));
  const std::string file = contentOf(out / "lidar" / "000000.ply");
  const Layout layout = plyLayout(file);
  expectPoint(file, layout, "float");
  EXPECT_EQ(layout.stamps().name, "time");
  ASSERT_EQ(layout.stamps().type, "double");
  const std::size_t stamp = layout.begin + layout.stamps().offset;
  EXPECT_EQ(at<double>(file, stamp), 0) << "after the scan's stamp";
  EXPECT_DOUBLE_EQ(at<double>(file, stamp + kPoint * layout.point_size), 0.002441403);
}

TEST_F(Interoperability, kissIcpFindsPositionsAndStampsInPcd)
{
  EXPECT_THAT(exported(CloudFormat::Pcd, ".pcd", "lidar"),
              ElementsAre("000000.pcd", "000001.pcd", "000002.pcd", "000003.pcd"));
  const std::string file = contentOf(out / "lidar" / "000000.pcd");
  const Layout layout = pcdLayout(file);
  expectPoint(file, layout, "F4");
  EXPECT_EQ(layout.stamps().name, "t");
  ASSERT_EQ(layout.stamps().type, "F8");
  EXPECT_FLOAT_EQ(at<double>(file, layout.begin + layout.stamps().offset + kPoint * layout.point_size), kTimeOfColumn1);
}

TEST_F(Interoperability, kissIcpReadsTheBinAsRowsOfFourFloats)
{
  EXPECT_THAT(exported(CloudFormat::Kitti, ".bin", "lidar/velodyne"),
              ElementsAre("000000.bin", "000001.bin", "000002.bin", "000003.bin"));
  const std::string file = contentOf(out / "lidar" / "velodyne" / "000000.bin");
  ASSERT_EQ(file.size(), kPoints * 4 * sizeof(float));
  EXPECT_FLOAT_EQ(at<float>(file, kPoint * 16), 0.4F);
  EXPECT_FLOAT_EQ(at<float>(file, kPoint * 16 + 8), 1.0F);
}

/** Reads on from the first occurrence of a name in the bytes. */
class Wire
{
 public:
  Wire(const std::string& bytes, const std::string& name) : bytes_(bytes), next_(bytes.find(name) + name.size()) {}

  template <typename T>
  T value()
  {
    next_ += sizeof(T);
    return at<T>(bytes_, next_ - sizeof(T));
  }
  std::string text()
  {
    const auto length = value<std::uint32_t>();
    next_ += length;
    return bytes_.substr(next_ - length, length);
  }
  template <typename T>
  std::vector<T> values(std::size_t count)
  {
    std::vector<T> all;
    for (std::size_t i = 0; i < count; ++i) all.push_back(value<T>());
    return all;
  }

  template <typename T>
  std::map<std::string, std::vector<T>> fields()
  {
    std::map<std::string, std::vector<T>> all;
    for (auto count = value<std::uint32_t>(); count > 0; --count)
    {
      const std::string name = text();
      const auto length = value<std::uint32_t>();
      all[name] = values<T>(length);
    }
    return all;
  }

 private:
  const std::string& bytes_;
  std::size_t next_;
};

TEST_F(Interoperability, molaFindsLabelsAndFieldsInTheRawlogItself)
{
  const std::string bytes = uncompressed(in);
  Wire observation(bytes, "mrpt::obs::CObservationPointCloud");
  EXPECT_EQ(observation.value<std::uint8_t>(), 0) << "version";
  EXPECT_EQ(observation.text(), "lidar");
  constexpr std::int64_t kTicksOf1970 = 116'444'736'000'000'000;  // of 100 ns since 1601
  EXPECT_EQ(observation.value<std::int64_t>(), kTicksOf1970 + 17'000'000'000'000'000) << "the start of the scan";

  Wire cloud(bytes, "mrpt::maps::CGenericPointsMap");
  EXPECT_EQ(cloud.value<std::uint8_t>(), 3) << "version, which MRPT 2.15.3 reads";
  const auto points = cloud.value<std::uint32_t>();
  ASSERT_EQ(points, kPoints);
  EXPECT_FLOAT_EQ(cloud.values<float>(points)[kPoint], 0.4F);
  cloud.values<float>(2 * points);
  auto floats = cloud.fields<float>();
  ASSERT_EQ(floats["t"].size(), points);
  EXPECT_FLOAT_EQ(floats["t"][kPoint], kTimeOfColumn1) << "s after the observation's stamp";
  ASSERT_EQ(floats["intensity"].size(), points);
  EXPECT_FLOAT_EQ(floats["intensity"][kPoint], 28.0F);
  EXPECT_TRUE(cloud.fields<double>().empty());
  auto whole = cloud.fields<std::uint16_t>();
  ASSERT_EQ(whole["ring"].size(), points);
  EXPECT_EQ(whole["ring"][kPoint], 1);

  const std::string imu_label = std::string("\3\0\0\0imu", 7);
  EXPECT_NE(bytes.find(imu_label, bytes.find("mrpt::obs::CObservationIMU")), std::string::npos);
}
}  // namespace
}  // namespace scanloom::interoperability_unittest
