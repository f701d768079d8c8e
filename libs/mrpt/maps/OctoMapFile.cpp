#include "mrpt/maps/OctoMapFile.h"

#include "base/core/OutputFile.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <bitset>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
std::runtime_error unreadable(const std::filesystem::path& path, const std::string& why)
{
  return std::runtime_error(fmt::format("{}: {}", path.string(), why));
}

struct Header
{
  std::string tree;
  std::size_t nodes = 0;
  double resolution = 0;
};

/** Not by OctoMap's own reader, which prints on stderr and accepts a file that is cut short. */
std::optional<Header> readHeader(std::istream& file)
{
  Header header;
  std::string line;
  if (!std::getline(file, line) || line.rfind("# Octomap", 0) != 0) return std::nullopt;
  while (std::getline(file, line) && line != "data")
  {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "id") words >> header.tree;
    if (key == "size") words >> header.nodes;
    if (key == "res") words >> header.resolution;
  }
  return file && header.resolution > 0 ? std::optional(header) : std::nullopt;
}

// OctoMap's readers do not check: at the end of the file they go on with old values. So the nodes are counted first.

void requireDepth(unsigned depth)
{
  constexpr unsigned kTreeDepth = 16;
  if (depth > kTreeDepth) throw std::invalid_argument("is damaged: deeper than an OcTree");
}

std::uint64_t nextBytes(std::istream& file, std::streamsize count)
{
  std::uint64_t value = 0;
  if (!file.read(reinterpret_cast<char*>(&value), count)) throw std::invalid_argument("is cut short");
  return value;
}

/** 4 bytes of log odds and a bit per child. */
std::size_t nodesOfFull(std::istream& file, unsigned depth = 0)
{
  requireDepth(depth);
  nextBytes(file, sizeof(float));
  const std::bitset<8> children(nextBytes(file, 1));
  std::size_t nodes = 1;
  for (unsigned i = 0; i < children.size(); ++i)
    if (children[i]) nodes += nodesOfFull(file, depth + 1);
  return nodes;
}

/** Two bits per child: 0 nothing, 1 and 2 a leaf, 3 a branch that follows. */
std::size_t nodesOfBinary(std::istream& file, unsigned depth = 0)
{
  requireDepth(depth + 1);
  std::uint64_t children = nextBytes(file, 2);
  std::size_t nodes = 1;
  for (; children != 0; children >>= 2)
  {
    if ((children & 3) == 3)
      nodes += nodesOfBinary(file, depth + 1);
    else if ((children & 3) != 0)
      ++nodes;
  }
  return nodes;
}

/** @param visit takes a leaf's centre and how many voxels it has along an edge. */
template <typename Visitor>
void forEachOccupiedLeaf(const octomap::OcTree& tree, Visitor&& visit)
{
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    if (tree.isNodeOccupied(*leaf)) visit(leaf.getCoordinate(), 1 << (tree.getTreeDepth() - leaf.getDepth()));
}

void requireListable(const octomap::OcTree& tree)
{
  const std::uint64_t voxels = occupiedVoxels(tree);
  if (voxels <= kMostListedVoxels) return;
  int largest = 0;
  forEachOccupiedLeaf(tree, [&](const auto&, int along_edge) { largest = std::max(largest, along_edge); });
  throw std::runtime_error(fmt::format(
      "the map's occupied leaves stand for {} voxels of {} m, more than the {} that are listed one by one; the largest "
      "is a cube of {:g} m: a coarser map, or a damaged one?",
      voxels, tree.getResolution(), kMostListedVoxels, largest * tree.getResolution()));
}

void requireWritten(bool written, const std::filesystem::path& path)
{
  if (!written) throw std::runtime_error(fmt::format("cannot write the OctoMap '{}'", path.string()));
}
}  // namespace

std::unique_ptr<octomap::OcTree> readOctoMap(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw unreadable(path, "cannot be read");
  const std::optional<Header> header = readHeader(file);
  if (!header) throw unreadable(path, "is no OctoMap (.bt or .ot)");
  if (header->tree != "OcTree")
    throw unreadable(path, fmt::format("holds a tree of kind {}, not OcTree", header->tree));

  const bool binary = path.extension() == ".bt";
  auto tree = std::make_unique<octomap::OcTree>(header->resolution);
  if (header->nodes == 0) return tree;
  const auto data = file.tellg();
  try
  {
    const std::size_t nodes = binary ? nodesOfBinary(file) : nodesOfFull(file);
    if (nodes != header->nodes)
      throw std::invalid_argument(fmt::format("is damaged: {} nodes, not {}", nodes, header->nodes));
  }
  catch (const std::invalid_argument& error)
  {
    throw unreadable(path, error.what());
  }
  file.seekg(data);
  binary ? tree->readBinaryData(file) : tree->readData(file);
  return tree;
}

void writeFullOctoMap(const std::filesystem::path& path, const octomap::OcTree& tree)
{
  writeAtomically(path, [&](std::ostream& file) { requireWritten(tree.write(file), path); });
}

void writeBinaryOctoMap(const std::filesystem::path& path, octomap::OcTree& tree)
{
  tree.toMaxLikelihood();
  tree.prune();
  writeAtomically(path,
                  [&](std::ostream& file)
                  {
                    // As OcTree::writeBinaryConst() writes it, but without its output on stderr.
                    fmt::print(file, "# Octomap OcTree binary file\nid {}\nsize {}\nres {}\ndata\n", tree.getTreeType(),
                               tree.size(), tree.getResolution());
                    tree.writeBinaryData(file);
                  });
}

std::uint64_t occupiedVoxels(const octomap::OcTree& tree)
{
  std::uint64_t count = 0;
  forEachOccupiedLeaf(tree,
                      [&](const auto&, int along_edge)
                      {
                        const auto edge = static_cast<std::uint64_t>(along_edge);
                        count += edge * edge * edge;
                      });
  return count;
}

void forEachOccupiedVoxel(const octomap::OcTree& tree, const std::function<void(const octomap::point3d&)>& visit)
{
  requireListable(tree);
  const double edge = tree.getResolution();
  forEachOccupiedLeaf(tree,
                      [&](const octomap::point3d& centre, int voxels)
                      {
                        const auto offset = [&](int i) { return static_cast<float>((i - 0.5 * (voxels - 1)) * edge); };
                        for (int x = 0; x < voxels; ++x)
                          for (int y = 0; y < voxels; ++y)
                            for (int z = 0; z < voxels; ++z)
                              visit(centre + octomap::point3d(offset(x), offset(y), offset(z)));
                      });
}
}  // namespace scanloom
