#include "base/formats/FileFormat.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>

#include "support/TemporaryFolder.h"

namespace scanloom::file_format_unittest
{
namespace
{
using namespace std::string_view_literals;

TEST(FileFormat, isToldByTheFirstBytes)
{
  EXPECT_EQ(formatOf("\xd4\xc3\xb2\xa1\x02\x00\x04\x00"sv), FileFormat::Capture);  // magic(5) of file: tcpdump
  EXPECT_EQ(formatOf("\x0a\x0d\x0d\x0a"sv), FileFormat::Capture);                  // pcapng
  EXPECT_EQ(formatOf("SQLite format 3\0"sv), FileFormat::Sqlite);
  EXPECT_EQ(formatOf("\x89MCAP0\r\n"sv), FileFormat::Mcap);
  EXPECT_EQ(formatOf("#ROSBAG V2.0\n"sv), FileFormat::Ros1Bag);
  EXPECT_EQ(formatOf("#ROSBAG V1.2\n"sv), FileFormat::Other);
  EXPECT_EQ(formatOf(""sv), FileFormat::Other);
}

TEST(FileFormat, isThatOfWhatAGzipFileHolds)
{
  const TemporaryFolder folder;
  const gzFile file = gzopen((folder / "x").c_str(), "wb");
  gzwrite(file, "\x89MCAP0\r\n", 8);
  gzclose(file);
  EXPECT_EQ(formatOfFile(folder / "x"), FileFormat::Mcap);
  EXPECT_THROW(formatOfFile(folder / "none"), std::runtime_error);
}

TEST(FileFormat, aFileThatIsRefusedIsDescribed)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "a") << "PK\x03\x04";
  std::ofstream(folder / "b") << "t x y z\n";
  EXPECT_EQ(describeFile(folder / "a"), "a zip file: unpack it first");
  EXPECT_EQ(describeFile(folder / "b"), "a text file");
  EXPECT_EQ(describeFile(folder / "none"), "no such file");
}
}  // namespace
}  // namespace scanloom::file_format_unittest
