#pragma once
#include "input/bags/BagReader.h"

#include <map>
#include <optional>

namespace scanloom
{
/** The files of one bag as one, ordered by receive time; topics of one name and type are one topic. */
class MergedBags : public BagReader
{
 public:
  explicit MergedBags(std::vector<std::unique_ptr<BagReader>>);

  const std::vector<BagTopic>& topics() const override { return topics_; }
  bool next(BagMessage&) override;
  std::vector<std::string> takeWarnings() override;
  double progress() const override;

 private:
  struct Part
  {
    std::unique_ptr<BagReader> bag;
    std::vector<std::size_t> topics;  // places in topics_
    BagMessage front;
    bool has_front = false;
  };
  void readOn(Part&);
  void addTopics(Part&);

  std::vector<Part> parts_;
  std::vector<BagTopic> topics_;
  std::map<std::pair<std::string, std::string>, std::size_t> places_;  // by name and type
  std::optional<std::size_t> taken_;                                   // part to read from at the next call
};
}  // namespace scanloom
