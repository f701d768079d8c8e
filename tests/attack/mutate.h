/** Damage to files, the same for the same random numbers. */
#pragma once
#include <random>
#include <string>

namespace scanloom
{
enum class Content
{
  Binary,
  Text,    // numbers become others, lines are lost, doubled or exchanged
  Packed,  // binary behind gzip: mostly what is inside is damaged
};

/** One to four changes, at least one of them in effect. Throws std::runtime_error if gzip cannot unpack it. */
std::string mutated(const std::string& content, Content, std::mt19937_64&);

std::string packed(const std::string& content);
std::string unpacked(const std::string& gzip);
}  // namespace scanloom
