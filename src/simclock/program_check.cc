#include "simclock/program_check.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

#include <elf.h>
#include <sys/stat.h>
#include <unistd.h>

namespace understudy::simclock {
namespace {

constexpr int kMostScripts = 4;  // that start each other, as the kernel has it

// They only ask another process to start the program.
constexpr std::string_view kElsewhere[] = {"docker", "podman", "nerdctl",     "ssh",       "sudo",
                                           "su",     "doas",   "systemd-run", "machinectl"};

std::filesystem::path Found(const std::string& name, const std::string& search_path) {
  if (name.find('/') != std::string::npos) return name;
  std::istringstream folders(search_path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path file = std::filesystem::path(folder) / name;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return name;
}

// The linker puts the mark of Go near the start of the data.
bool IsGo(std::ifstream& file) {
  constexpr std::string_view kMark = "\xff Go buildinf:";
  std::string window;
  std::vector<char> next(1 << 20);
  file.clear();
  file.seekg(0);
  while (file.read(next.data(), static_cast<std::streamsize>(next.size())), file.gcount() > 0) {
    window.append(next.data(), static_cast<std::size_t>(file.gcount()));
    if (std::search(window.begin(), window.end(),
                    std::boyer_moore_horspool_searcher(kMark.begin(), kMark.end())) !=
        window.end()) {
      return true;
    }
    window.erase(0, window.size() - std::min(window.size(), kMark.size()));
  }
  return false;
}

std::string WhyNot(const std::string& name, std::ifstream& file, const Elf64_Ehdr& head) {
  if (head.e_ident[EI_CLASS] != ELFCLASS64) return name + " is a program of 32 bits";
  std::string loader;
  for (int i = 0; i < head.e_phnum; ++i) {
    Elf64_Phdr part{};
    file.clear();
    file.seekg(static_cast<std::streamoff>(head.e_phoff) + i * head.e_phentsize);
    if (!file.read(reinterpret_cast<char*>(&part), sizeof(part))) break;
    if (part.p_type != PT_INTERP) continue;
    loader.resize(std::min<std::size_t>(part.p_filesz, 4096));
    file.seekg(static_cast<std::streamoff>(part.p_offset));
    file.read(loader.data(), static_cast<std::streamsize>(loader.size()));
  }
  if (IsGo(file)) return name + " is written in Go, which asks the kernel for the time by itself";
  if (loader.empty()) return name + " is linked statically";
  if (loader.find("ld-linux") == std::string::npos) return name + " is not linked with glibc";
  return "";
}

std::string WhyNot(const std::filesystem::path& program, const std::string& search_path,
                   int depth) {
  const std::string name = program.string();
  if (std::ranges::find(kElsewhere, program.filename().string()) != std::end(kElsewhere)) {
    return name + " starts the program elsewhere; run understudy there";
  }
  struct stat about {};
  if (::stat(name.c_str(), &about) != 0) return name + ": no such file";
  if ((about.st_mode & (S_ISUID | S_ISGID)) != 0) {
    return name + " is set-user-id or set-group-id, so that the loader ignores LD_PRELOAD";
  }
  std::ifstream file(program, std::ios::binary);
  std::array<char, 256> start{};
  file.read(start.data(), start.size() - 1);
  if (std::memcmp(start.data(), ELFMAG, SELFMAG) == 0) {
    Elf64_Ehdr head{};
    std::memcpy(&head, start.data(), sizeof(head));
    return WhyNot(name, file, head);
  }
  if (start[0] != '#' || start[1] != '!' || depth == kMostScripts) return "";
  std::istringstream line(
      std::string(start.data() + 2).substr(0, std::strcspn(start.data() + 2, "\n")));
  std::string interpreter, argument;
  line >> interpreter >> argument;
  std::string why = WhyNot(interpreter, search_path, depth + 1);
  const bool env = std::filesystem::path(interpreter).filename() == "env";
  if (why.empty() && env && !argument.empty() && argument[0] != '-') {
    why = WhyNot(Found(argument, search_path), search_path, depth + 1);
  }
  return why;
}

}  // namespace

std::string WhyNoClock(const std::filesystem::path& program, const std::string& search_path) {
  return WhyNot(program, search_path, 0);
}

}  // namespace understudy::simclock
