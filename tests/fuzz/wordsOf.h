/** Text of words that a parser knows, which a fuzzer would hardly find letter by letter. */
#pragma once
#include <array>
#include <string>

template <std::size_t count>
std::string wordsOf(const std::string& bytes, const std::array<std::string, count>& words)
{
  std::string text;
  for (const char byte : bytes) text += words[static_cast<unsigned char>(byte) % count];
  return text;
}
