#include "mrpt/observations/CGenericPointsMap.h"

#include "base/core/Bytes.h"
#include "mrpt/observations/registerClasses.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/version.h>

namespace scanloom::c_generic_points_map_unittest
{
namespace
{
using mrpt::maps::CGenericPointsMap;
using ByteVector = std::vector<std::uint8_t>;

/** Reads the wire format by its description alone, with nothing of MRPT's. */
class Wire
{
 public:
  explicit Wire(Bytes bytes) : bytes_(bytes) {}

  template <typename T>
  T value()
  {
    const T v = load<T>(bytes_, at_);
    at_ += sizeof(T);
    return v;
  }
  template <typename T>
  std::vector<T> values(std::size_t count)
  {
    std::vector<T> v(count);
    for (T& element : v) element = value<T>();
    return v;
  }
  std::string text(std::size_t length)
  {
    const auto chars = values<char>(length);
    return {chars.begin(), chars.end()};
  }
  std::string text() { return text(value<std::uint32_t>()); }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

/** Writes it, likewise. */
class WireWriter
{
 public:
  template <typename T>
  WireWriter& value(T v)
  {
    bytes.resize(bytes.size() + sizeof(T));
    store(bytes, bytes.size() - sizeof(T), v);
    return *this;
  }
  template <typename T>
  WireWriter& values(const std::vector<T>& all)
  {
    for (const T v : all) value(v);
    return *this;
  }
  WireWriter& text(const std::string& s)
  {
    value(static_cast<std::uint32_t>(s.size()));
    bytes.insert(bytes.end(), s.begin(), s.end());
    return *this;
  }
  ByteVector bytes;
};

ByteVector serialized(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << object;
  const auto* data = static_cast<const std::uint8_t*>(stream.getRawBufferData());
  return {data, data + stream.getTotalBytesCount()};
}

CGenericPointsMap::Ptr deserialized(const ByteVector& bytes)
{
  registerClasses();
  mrpt::io::CMemoryStream stream;
  stream.Write(bytes.data(), bytes.size());
  stream.Seek(0);
  auto archive = mrpt::serialization::archiveFrom(stream);
  return std::dynamic_pointer_cast<CGenericPointsMap>(archive.ReadObject());
}

CGenericPointsMap threePoints()
{
  CGenericPointsMap map;
  map.registerField_float("t");
  map.registerField_float("intensity");
  map.registerField_uint16("ring");
  map.registerField_uint16("column");
  map.registerField_uint8("sensor_id");
  map.resize(3);
  for (std::size_t i = 0; i < 3; i++)
  {
    map.setPointFast(i, 1.f + i, 10.f + i, 100.f + i);
    (*map.getPointsBufferRef_float_field("t"))[i] = 0.25f * i;
    (*map.getPointsBufferRef_float_field("intensity"))[i] = 200.f + i;
    (*map.getPointsBufferRef_uint16_field("ring"))[i] = static_cast<std::uint16_t>(5 + i);
    (*map.getPointsBufferRef_uint16_field("column"))[i] = static_cast<std::uint16_t>(1020 + i);
    (*map.getPointsBufferRef_uint8_field("sensor_id"))[i] = static_cast<std::uint8_t>(i % 2);
  }
  return map;
}

/** An object as MRPT frames it: name, version, `payload`, end flag. */
ByteVector framed(std::uint8_t version, const ByteVector& payload)
{
  const std::string name = "mrpt::maps::CGenericPointsMap";
  WireWriter w;
  w.value(static_cast<std::uint8_t>(0x80 | name.size()));
  w.bytes.insert(w.bytes.end(), name.begin(), name.end());
  w.value(version);
  w.bytes.insert(w.bytes.end(), payload.begin(), payload.end());
  w.value(std::uint8_t{0x88});
  return w.bytes;
}

constexpr bool kClassIsOurs = MRPT_VERSION < 0x20f00;

// insertionOptions and likelihoodOptions, each with its own version byte; since 2.15.3 without disableDeletion
constexpr std::size_t kOptionsSize = MRPT_VERSION < 0x20f03 ? 40 : 39;

/** The options at the end of every map, from a map that MRPT wrote. */
WireWriter& appendOptions(WireWriter& w)
{
  const ByteVector map = serialized(CGenericPointsMap());
  w.bytes.insert(w.bytes.end(), map.end() - 1 - kOptionsSize, map.end() - 1);
  return w;
}
}  // namespace

TEST(CGenericPointsMap, writesVersionThreeByteForByte)
{
  const ByteVector bytes = serialized(threePoints());
  Wire wire(bytes);

  ASSERT_EQ(wire.value<std::uint8_t>(), 0x80 | 29);
  EXPECT_EQ(wire.text(29), "mrpt::maps::CGenericPointsMap");
  EXPECT_EQ(wire.value<std::uint8_t>(), 3);

  ASSERT_EQ(wire.value<std::uint32_t>(), 3u);
  EXPECT_EQ(wire.values<float>(3), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(wire.values<float>(3), (std::vector<float>{10, 11, 12}));
  EXPECT_EQ(wire.values<float>(3), (std::vector<float>{100, 101, 102}));

  ASSERT_EQ(wire.value<std::uint32_t>(), 2u) << "float fields, in order of name";
  EXPECT_EQ(wire.text(), "intensity");
  ASSERT_EQ(wire.value<std::uint32_t>(), 3u);
  EXPECT_EQ(wire.values<float>(3), (std::vector<float>{200, 201, 202}));
  EXPECT_EQ(wire.text(), "t");
  ASSERT_EQ(wire.value<std::uint32_t>(), 3u);
  EXPECT_EQ(wire.values<float>(3), (std::vector<float>{0, 0.25, 0.5}));

  EXPECT_EQ(wire.value<std::uint32_t>(), 0u) << "double fields";

  ASSERT_EQ(wire.value<std::uint32_t>(), 2u) << "uint16 fields";
  EXPECT_EQ(wire.text(), "column");
  ASSERT_EQ(wire.value<std::uint32_t>(), 3u);
  EXPECT_EQ(wire.values<std::uint16_t>(3), (std::vector<std::uint16_t>{1020, 1021, 1022}));
  EXPECT_EQ(wire.text(), "ring");
  ASSERT_EQ(wire.value<std::uint32_t>(), 3u);
  EXPECT_EQ(wire.values<std::uint16_t>(3), (std::vector<std::uint16_t>{5, 6, 7}));

  ASSERT_EQ(wire.value<std::uint32_t>(), 1u) << "uint8 fields";
  EXPECT_EQ(wire.text(), "sensor_id");
  ASSERT_EQ(wire.value<std::uint32_t>(), 3u);
  EXPECT_EQ(wire.values<std::uint8_t>(3), (std::vector<std::uint8_t>{0, 1, 0}));

  EXPECT_EQ(wire.left(), kOptionsSize + 1);
  EXPECT_EQ(bytes.back(), 0x88) << "the end flag of the object";
}

TEST(CGenericPointsMap, readsBackWhatItWrote)
{
  const CGenericPointsMap map = threePoints();
  const auto back = deserialized(serialized(map));

  ASSERT_TRUE(back);
  EXPECT_EQ(back->size(), 3u);
  EXPECT_EQ(back->float_fields(), map.float_fields());
  EXPECT_EQ(back->double_fields(), map.double_fields());
  EXPECT_EQ(back->uint16_fields(), map.uint16_fields());
  EXPECT_EQ(back->uint8_fields(), map.uint8_fields());
  EXPECT_EQ(back->getPointsBufferRef_z()[2], 102);
}

// The older writers passed vectors to MRPT's operators: bare for float, with two names of types before all others.
using OlderVersion = testing::TestWithParam<int>;

TEST_P(OlderVersion, isRead)
{
  const auto version = static_cast<std::uint8_t>(GetParam());
  const auto typed = [](WireWriter& w, const std::string& type) -> WireWriter&
  { return w.text("std::vector").text(type).value(2u); };
  WireWriter w;
  w.value(2u).values<float>({1, 2, 3, 4, 5, 6});
  w.value(1u).text("t").value(2u).values<float>({0.5f, 0.75f});
  if (version >= 1) typed(w.value(1u).text("stamp"), "double").values<double>({7, 8});
  typed(w.value(1u).text("ring"), "uint16_t").values<std::uint16_t>({11, 12});
  if (version >= 2) typed(w.value(1u).text("sensor_id"), "uint8_t").values<std::uint8_t>({1, 0});
  appendOptions(w);

  const auto map = deserialized(framed(version, w.bytes));

  ASSERT_TRUE(map);
  ASSERT_EQ(map->size(), 2u);
  EXPECT_EQ(map->getPointsBufferRef_y()[1], 4);
  EXPECT_EQ(map->float_fields().at("t")[1], 0.75f);
  EXPECT_EQ(map->uint16_fields().at("ring")[1], 12);
  EXPECT_EQ(map->double_fields().count("stamp"), version >= 1 ? 1u : 0u);
  EXPECT_EQ(map->uint8_fields().count("sensor_id"), version >= 2 ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(CGenericPointsMap, OlderVersion, testing::Values(0, 1, 2));

TEST(CGenericPointsMap, refusesAnUnknownVersion) { EXPECT_THROW(deserialized(framed(5, {})), std::exception); }

TEST(CGenericPointsMap, refusesALengthBeyondTheDataWithoutTakingMemoryForIt)
{
  if (!kClassIsOurs) GTEST_SKIP() << "MRPT's own class takes it; what we read passes a CountedArchive";
  WireWriter w;
  w.value(0xFFFFFFFFu).values<float>({1, 2, 3});
  EXPECT_THROW(deserialized(framed(3, w.bytes)), std::exception);
}

TEST(CGenericPointsMap, refusesAFieldOfAnotherLengthThanItsPoints)
{
  if (!kClassIsOurs) GTEST_SKIP() << "MRPT's own class takes it; what we read passes a CountedArchive";
  WireWriter w;
  w.value(1u).values<float>({1, 2, 3});
  w.value(1u).text("t").value(2u).values<float>({1, 2});
  appendOptions(w.value(0u).value(0u).value(0u));
  EXPECT_THROW(deserialized(framed(3, w.bytes)), std::exception);
}

TEST(CGenericPointsMap, refusesASecondFieldOfTheSameName)
{
  CGenericPointsMap map = threePoints();
  EXPECT_THROW(map.registerField_uint8("t"), std::exception);
}

TEST(CGenericPointsMap, keepsItsFieldsInCopies)
{
  const CGenericPointsMap map = threePoints();
  const CGenericPointsMap copy = map;
  EXPECT_EQ(copy.uint16_fields(), map.uint16_fields());
  EXPECT_EQ(copy.size(), 3u);
}

TEST(CGenericPointsMap, takesPointsAndFieldsOfAnotherMapAtItsPose)
{
  CGenericPointsMap map = threePoints();
  const CGenericPointsMap other = threePoints();

  map.insertAnotherMap(&other, mrpt::poses::CPose3D(0, 0, 1000, 0, 0, 0));

  ASSERT_EQ(map.size(), 6u);
  EXPECT_EQ(map.getPointsBufferRef_z()[5], 1102);
  EXPECT_EQ(map.uint16_fields().at("column")[5], 1022);
  EXPECT_EQ(map.float_fields().at("t")[4], 0.25f);
}

#if !__has_include(<mrpt/maps/CGenericPointsMap.h>)  // MRPT's own has no uint32 before 3.0, and deletes otherwise
TEST(CGenericPointsMap, readsVersionFour)
{
  WireWriter w;
  w.value(1u).values<float>({1, 2, 3});
  w.value(0u).value(0u).value(0u).value(0u);
  w.value(1u).text("id").value(1u).value(70'000u);
  appendOptions(w);

  const auto map = deserialized(framed(4, w.bytes));

  ASSERT_TRUE(map);
  EXPECT_EQ(map->uint32_fields().at("id")[0], 70'000u);
}

TEST(CGenericPointsMap, losesNoUint32FieldsWhenWritten)
{
  CGenericPointsMap map;
  map.registerField_uint32("id");
  map.resize(1);
  (*map.getPointsBufferRef_uint32_field("id"))[0] = 70'000;

  EXPECT_EQ(deserialized(serialized(map))->uint32_fields().at("id")[0], 70'000u);
}

TEST(CGenericPointsMap, keepsFieldsWithTheirPointsWhenSomeAreDeleted)
{
  CGenericPointsMap map = threePoints();

  map.applyDeletionMask({true, false, true});

  ASSERT_EQ(map.size(), 1u);
  EXPECT_EQ(map.getPointsBufferRef_x()[0], 2);
  EXPECT_EQ(map.uint16_fields().at("column")[0], 1021);
}
#endif
}  // namespace scanloom::c_generic_points_map_unittest
