#include "mjcf/model_bytes.h"

#include <fstream>
#include <iterator>

#include <mujoco/mujoco.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::mjcf {

// By way of a file, in memory: into a buffer MuJoCo 2.2.2 writes less than it says it needs, does
// not say how much, and loads nothing that has more behind it.
std::string ModelBytes(const mjModel& model) {
  const int fd = ::memfd_create("model.mjb", MFD_CLOEXEC);
  if (fd < 0) throw ModelError("no memory for a copy of the model");
  const std::string file = "/proc/self/fd/" + std::to_string(fd);
  mj_saveModel(&model, file.c_str(), nullptr, 0);
  std::ifstream in(file, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  ::close(fd);
  if (bytes.empty()) throw ModelError("no copy of the model: MuJoCo cannot write to " + file);
  return bytes;
}

}  // namespace understudy::mjcf
