#include "base/core/Text.h"
#include "base/core/jsonText.h"
#include "input/bags/BagContents.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace scanloom
{
std::string toText(const BagContents& contents)
{
  std::string text = fmt::format("{:<44} {:<32} {:>9} {:>9} {:>9}  {}\n", "topic", "type", "messages", "span [s]",
                                 "rate [Hz]", "frame");
  for (const TopicContents& topic : contents.topics)
  {
    const double span = seconds(topic.last - topic.first);
    const double rate = span > 0 ? static_cast<double>(topic.messages - 1) / span : 0;
    text += fmt::format("{:<44} {:<32} {:>9} {:>9.3f} {:>9.2f}  {} {}\n", topic.name, topic.type, topic.messages, span,
                        rate, printable(topic.frame), printable(topic.note));
  }
  for (const auto& [topic, metadata] : contents.metadata)
    text += fmt::format("metadata of a lidar: {}\n", printable(topic));
  if (const auto frames = contents.frames.frames(); !frames.empty())
    text += fmt::format("static frames: {}\n", printable(fmt::format("{}", fmt::join(frames, ", "))));
  if (contents.unreadable > 0) text += fmt::format("messages that can't be read: {}\n", contents.unreadable);
  return text;
}

std::string toJson(const BagContents& contents)
{
  nlohmann::json topics = nlohmann::json::array();
  for (const TopicContents& topic : contents.topics)
    topics.push_back({{"name", topic.name},
                      {"type", topic.type},
                      {"messages", topic.messages},
                      {"first", nanoseconds(topic.first)},
                      {"last", nanoseconds(topic.last)},
                      {"frame", printable(topic.frame)}});
  nlohmann::json metadata = nlohmann::json::array();
  for (const auto& [topic, text] : contents.metadata) metadata.push_back(printable(topic));
  const nlohmann::json result = {
      {"topics", topics}, {"metadata", metadata}, {"unreadable", contents.unreadable}, {"damages", contents.warnings}};
  return jsonText(result) + "\n";
}
}  // namespace scanloom
