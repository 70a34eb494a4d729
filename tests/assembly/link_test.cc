// What the rooms up to assembly need of other libraries, as the linker sees it.
#include <cstdio>
#include <memory>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

namespace understudy::assembly {
namespace {

std::string OutputOf(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"),
                                                             &::pclose);
  std::string output(1 << 16, '\0');
  std::string all;
  while (const std::size_t read = std::fread(output.data(), 1, output.size(), pipe.get())) {
    all.append(output, 0, read);
  }
  return all;
}

// The symbols that nm calls undefined.
std::set<std::string> Needed(const std::string& nm_arguments) {
  std::istringstream lines(OutputOf(std::string(UNDERSTUDY_NM) + " -u " + nm_arguments));
  std::set<std::string> symbols;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t mark = line.find(" U ");
    if (mark == std::string::npos) continue;
    const std::string symbol = line.substr(mark + 3);
    symbols.insert(symbol.substr(0, symbol.find('@')));
  }
  return symbols;
}

// Those of `symbols` that open a socket, begin a thread, log or speak DDS.
std::set<std::string> Unwanted(const std::set<std::string>& symbols) {
  static const std::set<std::string> kCalls = {"accept",     "accept4", "bind",
                                               "connect",    "listen",  "pthread_create",
                                               "socketpair", "socket",  "thrd_create"};
  std::set<std::string> unwanted;
  for (const std::string& symbol : symbols) {
    const bool thread = symbol.starts_with("_ZNSt6thread");
    const bool log = symbol.find("spdlog") != std::string::npos;
    if (kCalls.contains(symbol) || symbol.starts_with("dds_") || thread || log) {
      unwanted.insert(symbol);
    }
  }
  return unwanted;
}

TEST(LinkTest, AProgramWithAWorldNeedsNoDdsNoLogNoThreadAndNoSocket) {
  const std::string libraries = OutputOf(UNDERSTUDY_READELF " -d " UNDERSTUDY_PROGRAM);
  ASSERT_THAT(libraries, testing::HasSubstr("libmujoco"));
  for (const char* library : {"ddsc", "spdlog", "fmt", "boost"}) {
    EXPECT_THAT(libraries, testing::Not(testing::HasSubstr(std::string("lib") + library)));
  }
  const std::set<std::string> needed = Needed("-D " UNDERSTUDY_PROGRAM);
  ASSERT_TRUE(needed.contains("mj_step1"));
  EXPECT_THAT(Unwanted(needed), testing::IsEmpty());
}

TEST(LinkTest, NoObjectUpToAssemblyNeedsThem) {
  const std::set<std::string> needed = Needed(UNDERSTUDY_ARCHIVES);
  ASSERT_TRUE(needed.contains("mj_step1"));
  EXPECT_THAT(Unwanted(needed), testing::IsEmpty());
}

}  // namespace
}  // namespace understudy::assembly
