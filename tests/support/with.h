#pragma once
#include <type_traits>
#include <utility>

namespace scanloom
{
/** Options that are the defaults, or `others`, but for one member; C++17 has no designated initialisers. */
template <typename Options, typename Member>
Options with(Member Options::*member, std::common_type_t<Member> value, Options others = {})
{
  others.*member = std::move(value);
  return others;
}
}  // namespace scanloom
