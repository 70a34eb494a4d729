#include "mjcf/compile.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>

#include <mujoco/mujoco.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/errors.h"
#include "mjcf/mujoco_hooks.h"

namespace understudy::mjcf {
namespace {

// A file that MuJoCo finds by name instead of on disk.
class MemoryFile {
 public:
  MemoryFile(const char* name, std::string_view text) : vfs_(std::make_unique<mjVFS>()) {
    mj_defaultVFS(vfs_.get());
    const int size = static_cast<int>(text.size());  // at most a few times ReadMjcf's bound
#if mjVERSION_HEADER < 300
    mj_makeEmptyFileVFS(vfs_.get(), name, size);
    std::memcpy(vfs_->filedata[mj_findFileVFS(vfs_.get(), name)], text.data(), text.size());
#else
    mj_addBufferVFS(vfs_.get(), name, text.data(), size);
#endif
  }
  ~MemoryFile() { mj_deleteVFS(vfs_.get()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const mjVFS* get() const { return vfs_.get(); }

 private:
  std::unique_ptr<mjVFS> vfs_;
};

constexpr char kUnknown[] = "Schema violation: unrecognized";

// MuJoCo counts lines of the text it was given: ", line 12" or "line = 12, column = -1".
std::string InTermsOfFiles(std::string message, const MjcfText& text) {
  for (char& c : message) {
    if (c == '\n') c = ' ';
  }
  static const std::regex kLine(",? *line =? ?([0-9]+)(, column = -?[0-9]+)?");
  std::string place = text.lines.front().file;
  std::smatch match;
  if (std::regex_search(message, match, kLine)) {
    const std::size_t line = std::strtoul(match.str(1).c_str(), nullptr, 10);
    if (line >= 1 && line <= text.lines.size()) place = text.lines[line - 1].text();
    message = match.prefix().str() + match.suffix().str();
  }
  message = std::regex_replace(message, std::regex(" +"), " ");
  message.erase(message.find_last_not_of(' ') + 1);
  if (message.find(kUnknown) != std::string::npos) {
    message += " (unknown to MuJoCo " + std::string(mj_versionString()) + ")";
  }
  return place + ": " + message;
}

// Removes the attribute from the first element of that name and place that has it, or, without an
// attribute, the first such element. Returns false if there is none.
bool TakeOut(MjcfElement* parent, const std::string& place, const std::string& name,
             const std::string& attribute) {
  for (auto child = parent->children.begin(); child != parent->children.end(); ++child) {
    if (child->place.text() == place && child->name == name) {
      if (attribute.empty()) {
        parent->children.erase(child);
        return true;
      }
      if (child->Find(attribute) != nullptr) {
        child->Drop(attribute);
        return true;
      }
    }
    if (TakeOut(&*child, place, name, attribute)) return true;
  }
  return false;
}

}  // namespace

void ModelDeleter::operator()(mjModel* model) const { mj_deleteModel(model); }
ModelHandle CopyOf(const mjModel& model) { return ModelHandle(mj_copyModel(nullptr, &model)); }

ModelHandle CompileMjcf(const MjcfElement& root, std::string* warning) {
  constexpr char kName[] = "understudy_world.xml";
  const MjcfText text = WriteMjcf(root);
  const MemoryFile file(kName, text.xml);
  std::array<char, 1000> error{};
  ModelHandle model(mj_loadXML(kName, file.get(), error.data(), static_cast<int>(error.size())));
  const std::string message = error[0] == '\0' ? "" : InTermsOfFiles(error.data(), text);
  if (!model) throw ModelError(message);
  if (warning != nullptr) *warning = message;
  return model;
}

std::string CountsText(const mjModel& model) {
  return std::to_string(model.nbody - 1) + " bodies, " + std::to_string(model.njnt) + " joints, " +
         std::to_string(model.nu) + " actuators";
}

// MuJoCo 2.2.2 does not ask.
const char* SheetAttribute() { return mjVERSION_HEADER < 300 ? "" : " inertia=\"shell\""; }

const char* MujocoVersion() { return mj_versionString(); }

std::vector<std::string> UnknownWords(MjcfElement root) {
  // place: XML Error: Schema violation: unrecognized attribute: 'x' Element 'y' (unknown ...)
  static const std::regex kAttribute("^(.*): XML Error: .*attribute: '(.*)' Element '(.*)' .*");
  static const std::regex kElement("^(.*): XML Error: .*unrecognized element Element '(.*)' .*");
  std::vector<std::string> unknown;
  while (true) {
    try {
      CompileMjcf(root);
      return unknown;
    } catch (const ModelError& error) {
      const std::string message = error.what();
      if (message.find(kUnknown) == std::string::npos) return unknown;
      unknown.push_back(message);
      std::smatch match;
      const bool taken = std::regex_match(message, match, kAttribute)
                             ? TakeOut(&root, match.str(1), match.str(3), match.str(2))
                             : std::regex_match(message, match, kElement) &&
                                   TakeOut(&root, match.str(1), match.str(2), "");
      if (!taken) return unknown;
    }
  }
}

// Uses a file in memory: into a buffer MuJoCo 2.2.2 writes less than it requests without reporting
// the size, and refuses to load a buffer with extra bytes.
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

ModelHandle ReadBinaryModel(std::string_view bytes, const std::string& what) {
  constexpr char kName[] = "model.mjb";
  InstallMujocoHooks();
  std::string why = "it is empty";
  if (!bytes.empty()) {
    try {
      if (ModelHandle model{mj_loadModel(kName, MemoryFile(kName, bytes).get())}) return model;
      const std::string_view warning = TakeMujocoWarning();
      why = warning.empty() ? "no reason given" : warning;
    } catch (const ModelError& error) {
      why = error.what();
    }
  }
  throw ModelError(what + ": not a model that MuJoCo " + mj_versionString() + " can read: " + why);
}

}  // namespace understudy::mjcf
