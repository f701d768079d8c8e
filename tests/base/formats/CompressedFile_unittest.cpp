/** Files that the programs gzip and zstd wrote. */
#include "base/formats/CompressedFile.h"

#include "support/TemporaryFolder.h"
#include "support/messageOf.h"
#include "support/runProgram.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

namespace scanloom::compressed_file_unittest
{
namespace
{
/** Half a megabyte, half of which repeats itself: several blocks of both formats. */
std::string someContent()
{
  std::mt19937 random(1);
  std::string content;
  for (int i = 0; i < 250'000; ++i) content += {'x', static_cast<char>(random())};
  return content;
}

std::string everythingIn(const std::filesystem::path& path)
{
  CompressedFile file(path);
  std::string content;
  char part[777];
  while (const std::size_t got = file.readUpTo(part, sizeof part)) content.append(part, got);
  EXPECT_TRUE(file.atEnd());
  EXPECT_EQ(file.bytesRead(), std::filesystem::file_size(path));
  return content;
}

std::string messageOfReading(const std::filesystem::path& path)
{
  return messageOf<std::runtime_error>([&] { uncompressedBytes(path); });
}
}  // namespace

class EveryCompression : public testing::TestWithParam<std::string>
{
 protected:
  void SetUp() override
  {
    std::ofstream(folder_ / "plain", std::ios::binary) << someContent();
    ASSERT_EQ(
        runProgram(fmt::format("{} < {} > {}", GetParam(), (folder_ / "plain").string(), packed_.string())).status, 0);
  }

  TemporaryFolder folder_;
  std::filesystem::path packed_ = folder_ / "packed";
};

TEST_P(EveryCompression, holdsWhatWasCompressed)
{
  EXPECT_TRUE(everythingIn(packed_) == someContent());
  EXPECT_EQ(uncompressedBytes(packed_), someContent().size());
}

TEST_P(EveryCompression, endsOnlyBehindItsLastByte)
{
  CompressedFile file(packed_);
  std::string all(someContent().size() - 1, '\0');
  file.read(all.data(), all.size());
  EXPECT_FALSE(file.atEnd());
  char last = 0;
  file.read(&last, 1);
  EXPECT_EQ(last, someContent().back());
  EXPECT_TRUE(file.atEnd());
}

TEST_P(EveryCompression, saysThatItIsCut)
{
  if (GetParam() == "cat") GTEST_SKIP() << "a plain file does not know its length";
  std::filesystem::resize_file(packed_, std::filesystem::file_size(packed_) / 2);
  EXPECT_THAT(messageOfReading(packed_), testing::EndsWith("packed: the compressed file is cut short"));
}

TEST_P(EveryCompression, saysThatItIsDamaged)
{
  if (GetParam() == "cat") GTEST_SKIP() << "a plain file has no checksum";
  std::fstream file(packed_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(100'000) << "damage";
  file.close();
  EXPECT_THAT(messageOfReading(packed_), testing::EndsWith("packed: the compressed data is damaged"));
}

INSTANTIATE_TEST_SUITE_P(Programs, EveryCompression,
                         testing::Values("cat", "gzip", "zstd", "zstd --long=27 -19", "tee /dev/null | zstd"));

TEST(CompressedFile, severalFramesAreOneStream)
{
  const TemporaryFolder folder;
  for (const char* program : {"gzip", "zstd"})
  {
    const auto path = (folder / program).string();
    runProgram(fmt::format("(echo -n ab | {0}; echo -n | {0}; echo -n cde | {0}) > {1}", program, path));
    EXPECT_EQ(everythingIn(path), "abcde") << program;
  }
}

TEST(CompressedFile, whatIsBehindGzipIsIgnoredAsByGunzip)
{
  const TemporaryFolder folder;
  const auto path = (folder / "padded").string();
  runProgram(fmt::format("(echo -n ab | gzip; head -c 600000 /dev/zero) > {}", path));
  EXPECT_EQ(uncompressedBytes(path), 2U);
}

TEST(CompressedFile, ofGzipThatIsCutWithinItsHeaderOrItsCheckSumIsCut)
{
  const TemporaryFolder folder;
  const auto path = (folder / "cut").string();
  runProgram(fmt::format("echo -n ab | gzip > {}", path));
  for (const int size : {21, 15, 9, 3})  // of 22: 10 of the header, 8 of the checksum
  {
    std::filesystem::resize_file(path, size);
    EXPECT_THAT(messageOfReading(path), testing::EndsWith("cut: the compressed file is cut short")) << size;
  }
}

TEST(CompressedFile, ofZerosThatWouldFillAMemoryIsDamaged)
{
  const TemporaryFolder folder;
  const auto path = (folder / "bomb").string();
  runProgram(fmt::format("head -c 100000000 /dev/zero | gzip > {}", path));
  EXPECT_THAT(messageOfReading(path), testing::HasSubstr("bomb: it unpacks to more than 64 times its size"));
}

TEST(CompressedFile, thatCannotBeReadIsNamed)
{
  const TemporaryFolder folder;
  EXPECT_THAT(messageOfReading("/nowhere/drive.rawlog"), testing::HasSubstr("/nowhere/drive.rawlog: No such file"));
  std::filesystem::create_directory(folder / "drive.rawlog");
  EXPECT_THAT(messageOfReading(folder / "drive.rawlog"), testing::EndsWith("drive.rawlog: is a directory"));
}
}  // namespace scanloom::compressed_file_unittest
