/** Messages of any type as their bytes, for Fast DDS 2 and 3, which name the same functions differently. */
#pragma once
#include <fastdds/dds/topic/TopicDataType.hpp>
#if SCANLOOM_FASTDDS >= 3
#include <fastdds/dds/core/ReturnCode.hpp>
#else
#include <fastrtps/types/TypesBase.h>
#endif

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
namespace fdds = eprosima::fastdds::dds;

#if SCANLOOM_FASTDDS >= 3
namespace rtps = eprosima::fastdds::rtps;
constexpr auto kFastddsOk = fdds::RETCODE_OK;
#else
namespace rtps = eprosima::fastrtps::rtps;
const auto kFastddsOk = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
#endif

class RawType : public fdds::TopicDataType
{
 public:
  using Data = std::vector<std::uint8_t>;

#if SCANLOOM_FASTDDS >= 3
  explicit RawType(const std::string& dds_type)
  {
    set_name(dds_type);
    max_serialized_type_size = kLargest;
  }

  bool serialize(const void* const data, rtps::SerializedPayload_t& payload, fdds::DataRepresentationId_t) override
  {
    return write(*static_cast<const Data*>(data), payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override { return read(payload, data); }
  std::uint32_t calculate_serialized_size(const void* const data, fdds::DataRepresentationId_t) override
  {
    return static_cast<std::uint32_t>(static_cast<const Data*>(data)->size());
  }
  void* create_data() override { return new Data; }
  void delete_data(void* data) override { delete static_cast<Data*>(data); }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void* const, rtps::InstanceHandle_t&, bool) override { return false; }
#else
  explicit RawType(const std::string& dds_type)
  {
    setName(dds_type.c_str());
    m_typeSize = kLargest;
    m_isGetKeyDefined = false;
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override
  {
    return write(*static_cast<Data*>(data), *payload);
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override { return read(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override
  {
    return [data] { return static_cast<std::uint32_t>(static_cast<Data*>(data)->size()); };
  }
  void* createData() override { return new Data; }
  void deleteData(void* data) override { delete static_cast<Data*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
#endif

 private:
  static constexpr std::uint32_t kLargest = 64 << 20;  // bytes

  static bool write(const Data& bytes, rtps::SerializedPayload_t& payload)
  {
    payload.encapsulation = CDR_LE;
    payload.length = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(payload.data, bytes.data(), bytes.size());
    return true;
  }
  static bool read(const rtps::SerializedPayload_t& payload, void* data)
  {
    static_cast<Data*>(data)->assign(payload.data, payload.data + payload.length);
    return true;
  }
};
}  // namespace scanloom
