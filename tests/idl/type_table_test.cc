// The vendor's C++ readers refuse a writer whose type differs from theirs, so each of our types
// must have the vendor's XTypes hash: the first 14 bytes of the MD5 of the serialised TypeObject,
// once without member names (minimal) and once with them (complete).
#include "idl/type_table.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <optional>
#include <ostream>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <dds/ddsc/dds_public_impl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace understudy::idl {
namespace {

constexpr std::size_t kVendorTypeCount = 76;  // 73 of unitree_sdk2 21d0a3b2, three of Inspire
// Robots send it, and no SDK of the vendor has it: nobody has a hash of it.
constexpr const char* kOfUsers = "unitree_go::msg::dds_::VoxelHeightMapState_";

// XTypes 1.3, 7.6.3.2.1 and Annex D: member ids of TypeInformation, discriminators of
// TypeIdentifier, length of an EquivalenceHash.
struct HashKind {
  std::uint32_t member_id;
  unsigned char discriminator;
};
constexpr HashKind kMinimal{0x1001, 0xF1};
constexpr HashKind kComplete{0x1002, 0xF2};
constexpr std::size_t kHashSize = 14;

// One type as the vendor publishes it (tests/data/README.md); hashes as 28 hexadecimal digits.
struct PublishedType {
  std::string name;
  std::string minimal;
  std::string complete;
};

std::vector<PublishedType> LoadPublishedTypes() {
  const std::string path = UNDERSTUDY_SOURCE_DIR "/tests/data/type_hashes.json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  const nlohmann::json published = nlohmann::json::parse(file);
  std::vector<PublishedType> types;
  for (const auto& [name, hashes] : published.items()) {
    types.push_back({name, hashes.at("minimal"), hashes.at("complete")});
  }
  return types;
}

// "unitree_go::msg::dds_::LowCmd_" becomes "unitree_go_LowCmd", which gtest takes for a name.
std::string TestName(std::string name) {
  constexpr std::string_view kScope = "::msg::dds_::";
  if (const auto at = name.find(kScope); at != std::string::npos) {
    name.replace(at, kScope.size(), "_");
    name.pop_back();
  }
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

void PrintTo(const PublishedType& type, std::ostream* out) { *out << TestName(type.name); }

// Little-endian number at `at`; nothing when the bytes end before it does.
std::optional<std::uint32_t> ReadWord(std::span<const unsigned char> bytes, std::size_t at) {
  if (at + 4 > bytes.size()) return std::nullopt;
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{bytes[at + i]} << (8 * i);
  return word;
}

// The hash of one kind in a serialised TypeInformation (little-endian XCDR2), as hexadecimal
// digits; empty when there is none. Each of its two members is
//
//   EMHEADER, length, DHEADER, DHEADER, discriminator, hash, size of the TypeObject, dependencies
std::string TypeHash(const dds_topic_descriptor& descriptor, HashKind kind) {
  constexpr std::uint32_t kMemberIdMask = 0x0FFFFFFF;
  const std::span<const unsigned char> bytes(descriptor.type_information.data,
                                             descriptor.type_information.sz);
  std::size_t at = 4;  // after the DHEADER of the whole
  while (true) {
    const auto header = ReadWord(bytes, at);
    const auto length = ReadWord(bytes, at + 4);
    if (!header || !length) return "";
    if ((*header & kMemberIdMask) == kind.member_id) break;
    at += 8 + *length;
  }
  at += 16;
  if (at + 1 + kHashSize > bytes.size() || bytes[at] != kind.discriminator) return "";
  std::ostringstream digits;
  digits << std::hex << std::setfill('0');
  for (const unsigned byte : bytes.subspan(at + 1, kHashSize)) digits << std::setw(2) << byte;
  return digits.str();
}

class PublishedTypeTest : public testing::TestWithParam<PublishedType> {};

TEST_P(PublishedTypeTest, HasTheVendorsTypeHashes) {
  const MessageType* type = FindMessageType(GetParam().name);
  ASSERT_NE(type, nullptr) << GetParam().name << " has no row in idl/type_table.cc";
  EXPECT_EQ(TypeHash(*type->descriptor, kMinimal), GetParam().minimal);
  EXPECT_EQ(TypeHash(*type->descriptor, kComplete), GetParam().complete);
}

INSTANTIATE_TEST_SUITE_P(Vendor, PublishedTypeTest, testing::ValuesIn(LoadPublishedTypes()),
                         [](const auto& row) { return TestName(row.param.name); });

TEST(TypeTableTest, HoldsTheTypesThatTheVendorPublishesAndTheOneOfUsersAlone) {
  std::set<std::string> published{kOfUsers};
  for (const PublishedType& type : LoadPublishedTypes()) published.insert(type.name);
  std::set<std::string> ours;
  for (const MessageType& type : MessageTypes()) ours.emplace(type.name);
  EXPECT_EQ(ours, published);
  EXPECT_EQ(published.size(), kVendorTypeCount + 1);
  EXPECT_EQ(MessageTypes().size(), kVendorTypeCount + 1);
}

TEST(TypeTableTest, NamesEachTypeAsItIsNamedOnTheWire) {
  for (const MessageType& type : MessageTypes()) {
    EXPECT_EQ(type.name, type.descriptor->m_typename);
  }
}

TEST(TypeTableTest, HoldsTypesWithoutKeysOnly) {
  for (const MessageType& type : MessageTypes()) {
    EXPECT_EQ(type.descriptor->m_nkeys, 0u) << type.name;
  }
}

TEST(TypeTableTest, FindsEveryTypeByItsName) {
  for (const MessageType& type : MessageTypes()) {
    EXPECT_EQ(FindMessageType(type.name), &type) << type.name;
  }
}

TEST(TypeTableTest, FindsNothingByANameThatIsNotTheWholeWireName) {
  for (const std::string_view name :
       {"", "LowCmd_", "unitree_go::msg::dds_::LowCmd", "unitree_go::msg::dds_::LowCmd__",
        "unitree_go/msg/LowCmd", "unitree_go::msg::dds_::lowcmd_", "zzz"}) {
    EXPECT_EQ(FindMessageType(name), nullptr) << name;
  }
}

}  // namespace
}  // namespace understudy::idl
