/**
 * Any bytes as a .bt or .ot: a tree of as many nodes as the file says, whose voxels can be counted and listed, or
 * std::runtime_error. The first byte chooses the kind, and between the rest as the whole file, as the nodes behind a
 * sound header, and as nodes that are mended to end where the file ends.
 * fuzz options: -max_len=512
 * fuzz sources: mrpt/maps/OctoMapFile.cpp
 * fuzz libs: scanloom_core octomap octomath
 */
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "MemoryFile.h"
#include "mrpt/maps/OctoMapFile.h"

using namespace scanloom;

namespace
{
constexpr unsigned kTreeDepth = 16;
constexpr std::size_t kChildren = 8;
constexpr std::array<const char*, 8> kResolutions{"0.1", "0.1", "0.05", "1e-300", "1e300", "0", "-1", "0.1 0.2"};

/** What follows a node in the file: its children that are branches, leaves in a .bt are counted only. */
struct Node
{
  std::size_t branches = 0, leaves = 0;
};

/** Walks over nodes as the formats' descriptions have them; where the bytes end, or a branch is too deep, zeros do. */
class Nodes
{
 public:
  Nodes(std::string bytes, bool binary) : bytes_(std::move(bytes)), binary_(binary) {}

  std::size_t mend(unsigned depth = 0)
  {
    const Node node = binary_ ? binaryNode(depth) : fullNode(depth);
    std::size_t nodes = 1 + node.leaves;
    for (std::size_t i = 0; i < node.branches; ++i) nodes += mend(depth + 1);
    return nodes;
  }

  const std::string& bytes()
  {
    bytes_.resize(next_);
    return bytes_;
  }

 private:
  char& take()
  {
    if (next_ == bytes_.size()) bytes_ += '\0';
    return bytes_[next_++];
  }

  Node binaryNode(unsigned depth)
  {
    Node node;
    for (int half = 0; half < 2; ++half)
    {
      char& byte = take();
      for (int shift = 0; shift < 8; shift += 2)
      {
        const int child = byte >> shift & 3;
        if (child == 3 && depth + 2 > kTreeDepth) byte = static_cast<char>(byte & ~(1 << shift));
        (byte >> shift & 3) == 3 ? ++node.branches : node.leaves += (byte >> shift & 3) != 0;
      }
    }
    return node;
  }

  Node fullNode(unsigned depth)
  {
    for (std::size_t i = 0; i < sizeof(float); ++i) take();
    char& mask = take();
    if (depth == kTreeDepth) mask = 0;
    Node node;
    for (std::size_t i = 0; i < kChildren; ++i) node.branches += mask >> i & 1;
    return node;
  }

  std::string bytes_;
  bool binary_;
  std::size_t next_ = 0;
};

std::string fileOf(std::uint8_t choice, bool binary, std::string rest)
{
  if ((choice & 6) == 6) return rest;
  Nodes nodes(rest, binary);
  const std::size_t count = nodes.mend();
  return std::string(binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file") + "\nid OcTree\nsize " +
         std::to_string(count) + "\nres " + kResolutions[choice >> 3 & 7] + "\ndata\n" +
         ((choice & 2) != 0 ? rest : nodes.bytes());
}

void use(const octomap::OcTree& tree)
{
  const std::uint64_t voxels = occupiedVoxels(tree);
  constexpr std::uint64_t kFew = 100'000;
  if (voxels > kFew) return;
  std::uint64_t listed = 0;
  forEachOccupiedVoxel(tree, [&](const octomap::point3d&) { ++listed; });
  require(listed == voxels);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const FuzzFolder folder;
  static const MemoryFile bt(folder, "map.bt"), ot(folder, "map.ot");
  if (size == 0) return 0;
  const bool binary = (data[0] & 1) != 0;
  const std::string file = fileOf(data[0], binary, std::string(data + 1, data + size));
  try
  {
    const auto tree = readOctoMap((binary ? bt : ot).holding(file));
    require(tree->size() <= kChildren * file.size());
    require(tree->size() == tree->calcNumNodes());
    use(*tree);
  }
  catch (const std::runtime_error&)
  {
    require((data[0] & 6) != 0 || (data[0] >> 3 & 7) > 4);  // what is mended is taken
  }
  return 0;
}
