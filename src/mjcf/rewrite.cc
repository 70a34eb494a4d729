#include "mjcf/rewrite.h"

#include <string>

#include "mjcf/actuators.h"

namespace understudy::mjcf {
namespace {

constexpr char kLooks[] = "changes looks only";
constexpr char kSolver[] = "MuJoCo 2.2.2 solves the same equations its own way";
constexpr char kBuiltIn[] = "that is how MuJoCo 2.2.2 does it";
constexpr char kAnything[] = "";

// An attribute of an element anywhere in the tree.
struct Entry {
  const char* element;
  const char* attribute;
  const char* value;  // removed only with this value; kAnything: with any
  const char* why;
  const char* renamed = nullptr;
};

constexpr Entry kEntries[] = {
    {"mesh", "content_type", kAnything, "the file's extension decides"},
    {"hfield", "content_type", kAnything, "the file's extension decides"},
    {"texture", "content_type", kAnything, "the file's extension decides"},
    {"mesh", "inertia", "legacy", kBuiltIn},
    {"texture", "colorspace", kAnything, kLooks},
    {"material", "metallic", kAnything, kLooks},
    {"material", "roughness", kAnything, kLooks},
    {"light", "bulbradius", kAnything, kLooks},
    {"light", "intensity", kAnything, kLooks},
    {"light", "range", kAnything, kLooks},
    {"camera", "sensorsize", kAnything, kLooks},
    {"camera", "focal", kAnything, kLooks},
    {"camera", "focalpixel", kAnything, kLooks},
    {"camera", "principal", kAnything, kLooks},
    {"camera", "principalpixel", kAnything, kLooks},
    {"camera", "resolution", kAnything, kLooks},
    {"camera", "orthographic", kAnything, kLooks},
    {"global", "bvactive", kAnything, kLooks},
    {"global", "cameraid", kAnything, kLooks},
    {"global", "ellipsoidinertia", kAnything, kLooks},
    {"global", "orthographic", kAnything, kLooks},
    {"global", "realtime", kAnything, "this program has its own pace"},
    {"rgba", "bv", kAnything, kLooks},
    {"rgba", "bvactive", kAnything, kLooks},
    {"rgba", "camera", kAnything, kLooks},
    {"rgba", "frustum", kAnything, kLooks},
    {"scale", "frustum", kAnything, kLooks},
    {"size", "memory", kAnything, "MuJoCo 2.2.2 sizes its memory by njmax and nconmax"},
    {"compiler", "alignfree", "false", kBuiltIn},
    {"compiler", "saveinertial", kAnything, "only saving a model uses it"},
    {"freejoint", "align", "false", kBuiltIn},
    {"freejoint", "align", "auto", kBuiltIn},
    {"body", "gravcomp", "0", kBuiltIn},
    {"joint", "actuatorgravcomp", "false", kBuiltIn},
    {"position", "timeconst", "0", kBuiltIn},
    {"option", "ls_iterations", kAnything, kSolver},
    {"option", "ls_tolerance", kAnything, kSolver},
    {"option", "sdf_iterations", kAnything, kSolver},
    {"option", "sdf_initpoints", kAnything, kSolver},
    {"option", "ccd_iterations", kAnything, "its name in MuJoCo 2.2.2", "mpr_iterations"},
    {"option", "ccd_tolerance", kAnything, "its name in MuJoCo 2.2.2", "mpr_tolerance"},
    {"flag", "nativeccd", kAnything, kSolver},
    {"flag", "island", kAnything, kSolver},
    {"flag", "midphase", kAnything, kSolver},
    {"flag", "autoreset", kAnything, "this program watches for divergence itself"},
    {"flag", "invdiscrete", kAnything, "only inverse dynamics use it"},
    {"flag", "eulerdamp", "enable", kBuiltIn},
    {"flag", "eulerdamp", "disable",
     "MuJoCo 2.2.2 always integrates joint damping implicitly, which is the more stable way and "
     "differs by the order of the time step"},
};

// MuJoCo 2.2.2 reads one number too many where spaces follow the last one, as in some keyframes.
void TrimEnds(MjcfElement* element) {
  for (auto& [name, value] : element->attributes) {
    value.erase(value.find_last_not_of(" \t\n\r") + 1);
  }
  for (MjcfElement& child : element->children) TrimEnds(&child);
}

// Removes or renames the attributes of the table. A setting that affects the robot's motion is
// removed only if it has the value that is built into 2.2.2; otherwise it stays, so that MuJoCo
// refuses it.
void Drop(MjcfElement* element, std::vector<Rewrite>* rewrites) {
  for (const Entry& entry : kEntries) {
    if (element->name != entry.element) continue;
    const std::string* found = element->Find(entry.attribute);
    if (found == nullptr) continue;
    const std::string value = *found;
    const std::string expected = entry.value;
    if (expected != kAnything && value != expected) continue;
    std::string what = "<" + element->name + "> " + entry.attribute + "=\"" + value + "\"";
    if (entry.renamed == nullptr) {
      what += " left out";
    } else {
      what += std::string(" became ") + entry.renamed;
      element->Set(entry.renamed, value);
    }
    element->Drop(entry.attribute);
    rewrites->push_back({element->place, what, entry.why});
  }
  if (element->name == "option" && element->Get("integrator") == "implicitfast") {
    element->Set("integrator", "implicit");
    rewrites->push_back({element->place, "integrator implicitfast became implicit",
                         "the same with Coriolis terms, which it leaves out, counted in"});
  }
  if (element->name == "light" && element->Find("type") != nullptr) {
    const std::string type = element->Get("type");
    element->Drop("type");
    if (type == "directional") element->Set("directional", "true");
    rewrites->push_back(
        {element->place, "<light> type=\"" + type + "\" became directional or not", kLooks});
  }
  for (MjcfElement& child : element->children) Drop(&child, rewrites);
}

// Returns the first element with a range but without `limited`.
const MjcfElement* FindImpliedLimit(const MjcfElement& element) {
  for (const auto& [range, limited] : {std::pair{"range", "limited"},
                                       {"ctrlrange", "ctrllimited"},
                                       {"forcerange", "forcelimited"},
                                       {"actrange", "actlimited"}}) {
    if (element.Find(range) != nullptr && element.Find(limited) == nullptr) return &element;
  }
  for (const MjcfElement& child : element.children) {
    if (const MjcfElement* found = FindImpliedLimit(child)) return found;
  }
  return nullptr;
}

// MuJoCo 3 limits elements with a range; 2.2.2 needs the attribute `limited`.
void SayAutolimits(MjcfElement* root, std::vector<Rewrite>* rewrites) {
  for (const MjcfElement& section : root->children) {
    if (section.name == "compiler" && section.Find("autolimits") != nullptr) return;
  }
  const MjcfElement* implied = FindImpliedLimit(*root);
  if (implied == nullptr) return;
  MjcfElement compiler;
  compiler.name = "compiler";
  compiler.place = root->place;
  compiler.Set("autolimits", "true");
  rewrites->push_back({implied->place, "<compiler autolimits=\"true\"/> added",
                       "a range without a word whether it limits; MuJoCo 3 takes it as a limit"});
  root->children.push_back(std::move(compiler));
}

}  // namespace

void RewriteForMujoco2(MjcfElement* root, std::vector<Rewrite>* rewrites) {
  TrimEnds(root);
  Drop(root, rewrites);
  SayAutolimits(root, rewrites);
  // Elements must not be added or removed below, as the following points into the tree.
  const MjcfDefaults defaults(*root);
  MjcfJoints joints = CollectJoints(root, defaults);
  LimitActuators(root, defaults, &joints, rewrites);
  RenameTorqueSensors(root, defaults, &joints, rewrites);
  SpellOutPositionGains(root, defaults, &joints, rewrites);
}

}  // namespace understudy::mjcf
