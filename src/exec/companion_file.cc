#include "exec/companion_file.h"

#include <system_error>

namespace understudy::exec {

std::filesystem::path CompanionFile(const std::string& program) {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return self.parent_path().parent_path() / "libexec" / "understudy" / program;
}

}  // namespace understudy::exec
