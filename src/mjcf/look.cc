#include "mjcf/look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/errors.h"
#include "base/files.h"
#include "mjcf/dae.h"
#include "mjcf/look_reader.h"
#include "mjcf/looks.h"
#include "mjcf/stl.h"
#include "mjcf/urdf_elements.h"
#include "mjcf/urdf_reader.h"

namespace understudy::mjcf {
namespace {

using std::filesystem::path;

constexpr std::size_t kMostLookFiles =
    5000;  // of a folder; *assumed*: a checkout has some hundreds
// Mean distance [m] between the frames of a look's bodies and the robot's up to which it is of this
// robot. Revisions of one robot differ by 2 cm, two kinds of humanoids by more; *assumed*.
constexpr double kSameRobot = 0.03;

// One file that may have the look, read.
struct Candidate {
  Look look;
  double apart = 0;     // m, mean distance of its bodies from the robot's
  int more_joints = 0;  // than the robot has, as those of other hands
  std::string fault;    // why it cannot be taken; "" if it can
};

MjcfElement ReadModel(const path& file) {
  if (LowerEnding(file) != ".urdf") return ReadMjcf(file);
  UrdfRobot robot = ReadUrdf(file, DaeUse::kNamed);
  for (MjcfElement& section : robot.model.children) {
    if (section.name != "asset") continue;
    for (MjcfElement& mesh : section.children) {
      const auto from = std::ranges::find(robot.meshes, mesh.Get("file"), &UrdfReadMesh::to);
      if (from != robot.meshes.end()) {
        mesh.Set("file", std::filesystem::absolute(from->from).lexically_normal().string());
      }
    }
  }
  return std::move(robot.model);
}

// Mean distance of the bodies that both have [m], without those of the world.
double ApartBy(const Bodies& a, const Bodies& b) {
  double sum = 0;
  int common = 0;
  for (const auto& [name, at] : a.at) {
    const auto other = b.at.find(name);
    if (other == b.at.end() || !at || !other->second) continue;
    sum += (*other->second - *at).norm();
    ++common;
  }
  return common > 0 ? sum / common : 0;
}

Candidate ReadCandidate(const path& file, const Bodies& robot) {
  Candidate candidate;
  try {
    const MjcfElement root = ReadModel(file);
    std::string lacks;
    candidate.look = ReadLook(file, root, robot, &lacks);
    const Bodies bodies = BodiesOf(root);
    candidate.apart = ApartBy(bodies, robot);
    for (const auto& [joint, body] : bodies.of_joint) {
      if (!robot.of_joint.contains(joint)) ++candidate.more_joints;
    }
    if (candidate.look.bodies.empty()) {
      candidate.fault =
          lacks.empty() ? file.string() + " has no mesh for a body of this robot" : lacks;
    } else if (candidate.apart > kSameRobot) {
      candidate.fault = file.string() + " is of another robot: its bodies stand " +
                        TextOf(std::round(candidate.apart * 1000) / 1000) + " m from this one's";
    }
  } catch (const ModelError& error) {
    candidate.fault = error.what();
  }
  return candidate;
}

bool NamesBody(const path& file, const Bodies& robot) {
  constexpr std::uintmax_t kMost = 4U << 20U;  // bytes: the vendor's largest has 0.2 MiB
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kMost) return false;
  std::string text(size, '\0');
  std::ifstream(file, std::ios::binary).read(text.data(), static_cast<std::streamsize>(size));
  return std::ranges::any_of(robot.at, [&](const auto& body) {
    return text.find('"' + body.first + '"') != std::string::npos;
  });
}

// Files of MJCF and URDF in a folder and those below, in the order of their names.
std::vector<path> ModelsBelow(const path& folder) {
  std::vector<path> files;
  std::error_code error;
  const auto options = std::filesystem::directory_options::skip_permission_denied;
  std::size_t seen = 0;
  for (std::filesystem::recursive_directory_iterator entry(folder, options, error), end;
       !error && entry != end; entry.increment(error)) {
    if (++seen > 100 * kMostLookFiles || files.size() >= kMostLookFiles) break;
    const path& file = entry->path();
    if (file.filename().string().starts_with('.')) {
      entry.disable_recursion_pending();
      continue;
    }
    const std::string ending = LowerEnding(file);
    std::error_code ignored;
    if ((ending == ".xml" || ending == ".urdf") && entry->is_regular_file(ignored)) {
      files.push_back(file);
    }
  }
  std::ranges::sort(files);
  return files;
}

[[noreturn]] void FailLook(const path& place, const std::string& why) {
  throw ModelError("look " + place.string() + ": " + why);
}

// An asset made of a part of a .dae, and the colour that the file gives it.
struct DaeAsset {
  std::string name;
  std::optional<std::array<double, 4>> rgba;
};
using DaeAssets = std::map<std::string, std::vector<DaeAsset>>;  // by the mesh that is the .dae

// Puts STL in place of meshes in .dae.
DaeAssets ReadDaes(Look* look) {
  DaeAssets assets;
  std::vector<MjcfElement> meshes;
  for (MjcfElement& mesh : look->meshes) {
    const path file = mesh.Get("file");
    if (LowerEnding(file) != ".dae") {
      meshes.push_back(std::move(mesh));
      continue;
    }
    if (look->made == nullptr) look->made = std::make_shared<TemporaryFolder>("look");
    std::vector<DaeAsset>& parts = assets[mesh.Get("name")];
    for (const MeshPart& part : ReadDae(file)) {
      for (const std::string& stl : Stls(part.corners)) {
        parts.push_back({mesh.Get("name") + "_" + std::to_string(parts.size() + 1), part.rgba});
        const path to = look->made->path() / (std::to_string(meshes.size()) + ".stl");
        WriteFile(to, stl);
        meshes.push_back(mesh);
        meshes.back().Set("name", parts.back().name);
        meshes.back().Set("file", to.string());
      }
    }
  }
  look->meshes = std::move(meshes);
  return assets;
}

// Gives each geom of a .dae in a look one for each of its assets.
Look WithoutDae(Look look) {
  const DaeAssets assets = ReadDaes(&look);
  for (LookOfBody& body : look.bodies) {
    std::vector<MjcfElement> geoms;
    for (MjcfElement& geom : body.geoms) {
      const auto found = assets.find(geom.Get("mesh"));
      if (found == assets.end()) {
        geoms.push_back(std::move(geom));
        continue;
      }
      for (const DaeAsset& asset : found->second) {
        MjcfElement& own = geoms.emplace_back(geom);
        own.Set("mesh", asset.name);
        if (asset.rgba) own.Set("rgba", NumbersText(*asset.rgba));
      }
    }
    body.geoms = std::move(geoms);
  }
  return look;
}

MjcfElement Dressed(const MjcfElement& element, const Look& look,
                    const std::set<const MjcfElement*>& seen) {
  MjcfElement dressed{element.name, element.attributes, {}, element.place};
  const LookOfBody* own = nullptr;
  if (element.name == "body") {
    const auto found = std::ranges::find(look.bodies, element.Get("name"), &LookOfBody::body);
    if (found != look.bodies.end()) own = &*found;
  }
  for (const MjcfElement& child : element.children) {
    if (own != nullptr && seen.contains(&child)) continue;
    dressed.children.push_back(Dressed(child, look, seen));
  }
  if (own != nullptr) {
    dressed.children.insert(dressed.children.end(), own->geoms.begin(), own->geoms.end());
  }
  return dressed;
}

}  // namespace

Look FindLook(const std::filesystem::path& place, const MjcfElement& robot) {
  const Bodies bodies = BodiesOf(robot);
  if (bodies.at.empty()) FailLook(place, "the robot has no body with a name");
  std::error_code error;
  std::vector<path> files;
  if (std::filesystem::is_directory(place, error)) {
    files = ModelsBelow(place);
    if (files.empty())
      FailLook(place, "expected MJCF (.xml) or URDF (.urdf) there or in a folder below");
    std::erase_if(files, [&](const path& file) { return !NamesBody(file, bodies); });
  } else if (std::filesystem::is_regular_file(place, error)) {
    files.push_back(place);
  } else {
    FailLook(place, "no such file or folder; expected a copy of unitree_ros or unitree_mujoco");
  }
  std::optional<Candidate> best;
  std::string fault;
  for (const path& file : files) {
    Candidate candidate = ReadCandidate(file, bodies);
    if (!candidate.fault.empty()) {
      if (fault.empty()) fault = candidate.fault;
      continue;
    }
    const auto rank = [](const Candidate& c) {
      std::ptrdiff_t geoms = 0;
      for (const LookOfBody& body : c.look.bodies) geoms += std::ssize(body.geoms);
      const double millimetres = std::round(1000 * c.apart);  // files round their figures
      return std::tuple(-std::ssize(c.look.bodies), millimetres, c.more_joints, -geoms);
    };
    if (!best || rank(candidate) < rank(*best)) best = std::move(candidate);
  }
  if (best) return WithoutDae(std::move(best->look));
  FailLook(place, fault.empty()
                      ? "no file of MJCF or URDF there has a body of this robot, such as '" +
                            bodies.at.begin()->first + "'"
                      : fault);
}

void PutOn(const Look& look, MjcfElement* robot) {
  *robot = Dressed(*robot, look, VisualGeoms(*robot));
  robot->children.push_back(
      {.name = "asset", .attributes = {}, .children = look.meshes, .place = robot->place});
}

}  // namespace understudy::mjcf
