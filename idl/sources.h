#ifndef UNDERSTUDY_IDL_SOURCES_H_
#define UNDERSTUDY_IDL_SOURCES_H_

#include <span>
#include <string_view>

namespace understudy {

// The text of every file of idl/, in no particular order.
std::span<const std::string_view> IdlSources();

}  // namespace understudy

#endif  // UNDERSTUDY_IDL_SOURCES_H_
