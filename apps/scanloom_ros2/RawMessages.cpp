#include "RawMessages.h"

#include <dds/ddsi/q_radmin.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

namespace scanloom
{
namespace
{
/** As in files (BagReader): no message of a lidar comes near it. */
constexpr std::size_t kLargestMessage = 256'000'000;

// Cyclone sends, and asks for, whole words of four bytes: there is memory up to the next one.
constexpr std::size_t kWord = 4;

struct RawMessage : ddsi_serdata
{
  RawMessage(const ddsi_sertype* its_type, ddsi_serdata_kind its_kind, std::vector<std::uint8_t> content)
    : ddsi_serdata{}, size(content.size()), words(std::move(content))
  {
    ddsi_serdata_init(this, its_type, its_kind);
    words.resize((size + kWord - 1) / kWord * kWord);
  }

  std::size_t size;
  std::vector<std::uint8_t> words;  // the message, and zeros up to a whole word
};

const RawMessage& raw(const ddsi_serdata* message) { return *static_cast<const RawMessage*>(message); }

/** Cyclone is C: an exception must not reach it. What has no memory, or is too large, is no message. */
template <typename Make>
ddsi_serdata* madeOrNone(std::size_t size, const Make& make)
{
  if (size > kLargestMessage) return nullptr;
  try
  {
    return make().release();
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}

ddsi_serdata* fromFragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                            std::size_t size)
{
  return madeOrNone(
      size,
      [&]
      {
        std::vector<std::uint8_t> bytes(size);
        std::uint32_t filled = 0;  // fragments come in order, but may overlap
        for (; fragment; fragment = fragment->nextfrag)
        {
          if (fragment->maxp1 <= filled) continue;
          const unsigned char* const payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
          std::memcpy(bytes.data() + filled, payload + (filled - fragment->min), fragment->maxp1 - filled);
          filled = fragment->maxp1;
        }
        return std::make_unique<RawMessage>(type, kind, std::move(bytes));
      });
}

ddsi_serdata* fromParts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t parts,
                        const ddsrt_iovec_t* part, std::size_t size)
{
  return madeOrNone(size,
                    [&]
                    {
                      std::vector<std::uint8_t> bytes;
                      bytes.reserve(size);
                      for (ddsrt_msg_iovlen_t i = 0; i < parts; ++i)
                      {
                        const auto* const begin = static_cast<const std::uint8_t*>(part[i].iov_base);
                        bytes.insert(bytes.end(), begin, begin + part[i].iov_len);
                      }
                      return std::make_unique<RawMessage>(type, kind, std::move(bytes));
                    });
}

ddsi_serdata* withoutContent(const ddsi_sertype* type)
{
  return madeOrNone(0, [&] { return std::make_unique<RawMessage>(type, SDK_KEY, std::vector<std::uint8_t>{}); });
}

/** Topics of ROS 2 have no keys: all messages are of one instance, which has no content. */
ddsi_serdata* untyped(const ddsi_serdata* message)
{
  ddsi_serdata* const instance = withoutContent(message->type);
  if (instance) instance->type = nullptr;
  return instance;
}

ddsi_serdata* referToPart(const ddsi_serdata* message, std::size_t offset, std::size_t size, ddsrt_iovec_t* part)
{
  part->iov_base = const_cast<std::uint8_t*>(raw(message).words.data()) + offset;
  part->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(message);
}

void copyPart(const ddsi_serdata* message, std::size_t offset, std::size_t size, void* to)
{
  std::memcpy(to, raw(message).words.data() + offset, size);
}

const ddsi_serdata_ops* messageOperations()
{
  static const ddsi_serdata_ops operations = []
  {
    ddsi_serdata_ops o{};
    o.eqkey = [](const ddsi_serdata*, const ddsi_serdata*) { return true; };
    o.get_size = [](const ddsi_serdata* message) { return static_cast<std::uint32_t>(raw(message).size); };
    o.from_ser = &fromFragments;
    o.from_ser_iov = &fromParts;
    o.from_keyhash = [](const ddsi_sertype* type, const ddsi_keyhash*) { return withoutContent(type); };
    o.from_sample = [](const ddsi_sertype* type, ddsi_serdata_kind, const void*) { return withoutContent(type); };
    o.to_ser = &copyPart;
    o.to_ser_ref = &referToPart;
    o.to_ser_unref = [](ddsi_serdata* message, const ddsrt_iovec_t*) { ddsi_serdata_unref(message); };
    o.to_sample = [](const ddsi_serdata*, void*, void**, void*) { return false; };  // samples are taken as bytes
    o.to_untyped = &untyped;
    o.untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; };
    o.free = [](ddsi_serdata* message) { delete static_cast<RawMessage*>(message); };
    o.print = [](const ddsi_sertype*, const ddsi_serdata* message, char* text, std::size_t size)
    { return static_cast<std::size_t>(std::snprintf(text, size, "%zu bytes", raw(message).size)); };
    o.get_keyhash = [](const ddsi_serdata*, ddsi_keyhash* hash, bool) { std::memset(hash, 0, sizeof *hash); };
    return o;
  }();
  return &operations;
}

const ddsi_sertype_ops* typeOperations()
{
  static const ddsi_sertype_ops operations = []
  {
    ddsi_sertype_ops o{};
    o.version = ddsi_sertype_v0;
    o.free = [](ddsi_sertype* type)
    {
      ddsi_sertype_fini(type);
      delete type;
    };
    // Only messages as bytes are written and taken: there are no samples to be cleared, moved or freed.
    o.zero_samples = [](const ddsi_sertype*, void*, std::size_t) {};
    o.realloc_samples = [](void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {};
    o.free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {};
    o.equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; };
    o.hash = [](const ddsi_sertype*) { return std::uint32_t{0}; };
    return o;
  }();
  return &operations;
}
}  // namespace

ddsi_sertype* rawType(const std::string& dds_type)
{
  auto* const type = new ddsi_sertype{};
  ddsi_sertype_init_flags(type, dds_type.c_str(), typeOperations(), messageOperations(),
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

ddsi_serdata* rawMessage(const ddsi_sertype* type, std::vector<std::uint8_t> bytes)
{
  return new RawMessage(type, SDK_DATA, std::move(bytes));
}

Bytes bytesOf(const ddsi_serdata* message) { return {raw(message).words.data(), raw(message).size}; }
}  // namespace scanloom
