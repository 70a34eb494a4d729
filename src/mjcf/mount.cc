#include "mjcf/mount.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "base/errors.h"
#include "mjcf/join.h"

namespace understudy::mjcf {
namespace {

// Returns the element of that kind and name below `parent`, null if there is none.
MjcfElement* Named(MjcfElement* parent, const std::string& kind, const std::string& name) {
  for (MjcfElement& child : parent->children) {
    if (child.name == kind && child.Get("name") == name) return &child;
    if (MjcfElement* found = Named(&child, kind, name)) return found;
  }
  return nullptr;
}

bool IsBody(const MjcfElement& element) { return element.name == "body"; }

// Whether every body below has an inertia of its own, and takes none from its geoms.
bool AllHaveInertia(const MjcfElement& element) {
  return std::ranges::all_of(element.children, [](const MjcfElement& child) {
    if (!IsBody(child)) return child.name != "worldbody" || AllHaveInertia(child);
    return std::ranges::find(child.children, "inertial", &MjcfElement::name) !=
               child.children.end() &&
           AllHaveInertia(child);
  });
}

// Reads the hand as a robot is read whose geoms give no inertia, where that changes nothing.
void TakeNoInertiaFromGeoms(const MjcfElement& root, MjcfElement* hand) {
  constexpr char kKey[] = "inertiafromgeom";
  if (CompilerSays(root, kKey) != "false" || CompilerSays(*hand, kKey) == "true") return;
  if (!AllHaveInertia(*hand)) return;
  MjcfElement compiler{"compiler", {}, {}, hand->place};
  compiler.Set(kKey, "false");
  hand->children.push_back(std::move(compiler));
}

void Mount(MjcfElement hand, MjcfElement* root) {
  TakeNoInertiaFromGeoms(*root, &hand);
  for (MjcfElement& section : hand.children) {
    if (section.name != "worldbody") continue;
    for (MjcfElement& body : section.children) {
      MjcfElement* wrist = Named(root, "body", body.Get("name"));
      if (wrist == nullptr) {
        throw ModelError(body.place.text() + ": a hand for the body '" + body.Get("name") +
                         "', which " + root->place.file + " does not have");
      }
      std::erase_if(wrist->children, [](const MjcfElement& e) { return e.name != "joint"; });
      std::ranges::move(body.children, std::back_inserter(wrist->children));
    }
  }
  std::erase_if(hand.children, [&](const MjcfElement& section) {
    return section.name == "worldbody" ||
           std::ranges::any_of(root->children, [&](const MjcfElement& known) {
             return known.place.text() == section.place.text();
           });
  });
  std::vector<std::string> options;  // of the robot
  Join(std::move(hand), root, &options);
}

}  // namespace

void MountHands(const robot::RobotSpec& spec, std::vector<MjcfElement> hands, MjcfElement* root) {
  if (hands.empty()) return;
  if (Named(root, "joint", spec.hands.front().motors.front().joint) != nullptr) return;
  for (MjcfElement& hand : hands) Mount(std::move(hand), root);
}

}  // namespace understudy::mjcf
