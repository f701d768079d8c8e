#pragma once
#include "input/bags/internal/SensorMessages.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** The static transforms of a recording: how its sensors stand to each other. */
class FrameTree
{
 public:
  /** Replaces what was known of the child's parent. Transforms to itself, and of frames without a name, are none. */
  void add(const FrameTransform&);

  /** Frames whose parents lead in a circle: they are connected with nothing. */
  std::vector<std::string> inCircles() const;

  /** to_T_from; none if the frames are not connected. Every frame is known to itself. */
  std::optional<Rigid> transform(const std::string& to, const std::string& from) const;

  bool has(const std::string& frame) const;

  /** The frame above all others that the given one hangs from; the frame itself if it hangs from none. */
  std::string rootOf(const std::string& frame) const;

  /** In alphabetical order. */
  std::vector<std::string> frames() const;

 private:
  struct Link
  {
    std::string parent;
    Rigid parent_T_child;
  };
  struct Ancestor
  {
    std::string frame;
    Rigid ancestor_T_frame;
  };
  std::vector<Ancestor> ancestorsOf(const std::string& frame) const;

  std::map<std::string, Link> links_;  // by child
};
}  // namespace scanloom
