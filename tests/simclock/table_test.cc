// What libc exports with a clock or a time-out against what the library answers.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <elf.h>
#include <gmock/gmock.h>
#include <gnu/lib-names.h>
#include <link.h>

namespace understudy::simclock {
namespace {

using testing::IsEmpty;

std::string FileOf(const char* library) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t at = line.find('/');
    if (at != std::string::npos && line.ends_with(library)) return line.substr(at);
  }
  return library;
}

// The names that a library exports.
std::set<std::string> Exports(const std::string& library) {
  std::ifstream in(library, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  const auto read = [&file](std::size_t at, auto* to) {
    std::memcpy(to, file.data() + at, sizeof(*to));
  };
  Elf64_Ehdr head{};
  read(0, &head);
  std::set<std::string> names;
  for (std::size_t i = 0; i < head.e_shnum; ++i) {
    Elf64_Shdr table{}, texts{};
    read(head.e_shoff + i * head.e_shentsize, &table);
    if (table.sh_type != SHT_DYNSYM) continue;
    read(head.e_shoff + table.sh_link * head.e_shentsize, &texts);
    for (std::size_t at = 0; at < table.sh_size; at += sizeof(Elf64_Sym)) {
      Elf64_Sym one{};
      read(table.sh_offset + at, &one);
      if (one.st_shndx != SHN_UNDEF) {
        names.insert(file.data() + texts.sh_offset + one.st_name);
      }
    }
  }
  return names;
}

// Names of libc that look like these, and are neither waits nor clocks, or are left on real time.
bool IsKnown(const std::string& name) {
  static const std::set<std::string> known = {
      // Dates of files, and dates made of numbers.
      "utime",
      "utimes",
      "lutimes",
      "futimes",
      "futimens",
      "futimesat",
      "utimensat",
      "asctime",
      "ctime",
      "gmtime",
      "localtime",
      "mktime",
      "strftime",
      "strptime",
      "wcsftime",
      "getdate",
      "difftime",
      "timegm",
      "timelocal",
      "dysize",
      "timespec_getres",
      "stime",
      "clock_getres",
      // The processor's time.
      "clock",
      "times",
      "clock_getcpuclockid",
      "pthread_getcpuclockid",
      // Sets the computer's clock, which programs may not.
      "clock_settime",
      "settimeofday",
      "adjtime",
      "adjtimex",
      "clock_adjtime",
      "ntp_adjtime",
      "ntp_gettime",
      "ntp_gettimex",
      // Attributes.
      "pthread_condattr_getclock",
      "pthread_condattr_setclock",
      // Of name servers, which a private network has not; obsolete ones.
      "gai_suspend",
      "timezone",
      "epoll_create",
      "epoll_create1",
      "epoll_ctl",
      "ftime",
      "clnt_pcreateerror",
  };
  return known.contains(name) || name.starts_with("__") || name.starts_with("_") ||
         name.starts_with("svc") || name.starts_with("clnt") || name.starts_with("str") ||
         name.starts_with("wcs") || name.ends_with("_r") || name.ends_with("64") ||
         name.starts_with("rtime") || name.starts_with("profil") || name.starts_with("xdr") ||
         name.starts_with("inet6_");
}

TEST(TableTest, NoWaitOrClockOfLibcSlipsByTheLibrary) {
  const std::set<std::string> ours = Exports(UNDERSTUDY_SIMCLOCK);
  const std::regex pattern(
      "(.*(timed|clock|sleep|poll|select|itimer|alarm|timer|timespec|timeval|suspend|timeofday).*"
      "|.*time|time.*|epoll_.*wait.*|.*cond_.*|cnd_.*|sig.*wait.*|wait.*)");
  std::vector<std::string> missing;
  for (const std::string& name : Exports(FileOf(LIBC_SO))) {
    if (!std::regex_match(name, pattern) || ours.contains(name) || IsKnown(name)) continue;
    missing.push_back(name);
  }
  EXPECT_THAT(missing, IsEmpty());
}

TEST(TableTest, TheLibraryExportsNothingBesidesLibcsNamesAndWhatUnderstudyCalls) {
  const std::set<std::string> libc = Exports(FileOf(LIBC_SO));
  std::vector<std::string> others;
  for (const std::string& name : Exports(UNDERSTUDY_SIMCLOCK)) {
    if (!libc.contains(name) && name != "simclock_hold" && name != "simclock_stand") {
      others.push_back(name);
    }
  }
  EXPECT_THAT(others, IsEmpty());
}

}  // namespace
}  // namespace understudy::simclock
