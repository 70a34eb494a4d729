// The vendor's topics and their types.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy::doctor {

// Returns the types that the vendor's robots have on the topic, "" for none of the vendor's topics
// that are known here. A topic of requests or responses is known whatever its service is.
std::vector<std::string_view> TypesOf(std::string_view topic);

// Returns the known topics, without those of services.
std::vector<std::string> VendorTopics();

// Returns "go" or "hg", the family whose type that is, "" for one of both or of none.
std::string_view FamilyOf(std::string_view type);

}  // namespace understudy::doctor
