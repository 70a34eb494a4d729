// The definition of a policy: its observations, its action, the gains of its motors. It has the
// keys and the meaning of the vendor's deploy.yaml (docs/reference/policies.md,
// docs/dev/sources.md#policies).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace understudy::policy {

struct TermRow;

using Limits = std::array<float, 2>;  // least, most

// One observation: the values of its row over the last steps.
struct Term {
  const TermRow* row = nullptr;
  std::vector<float> scale{};         // by value
  std::optional<Limits> clip{};       // of each value
  std::size_t history = 1;            // steps that the network sees
  std::vector<std::size_t> joints{};  // of joint_pos, joint_pos_rel, joint_vel_rel: policy order
  float period = 0;                   // s, of gait_phase
};

// The action JointPositionAction: target = action * scale + offset, then clipped, rad.
struct Action {
  std::vector<std::size_t> joints{};  // policy order
  std::vector<float> scale{}, offset{};
  std::vector<Limits> clip{};  // empty: none
};

// Lists over joints have the policy's order, unless they say otherwise.
struct Definition {
  std::string name{};                      // of its file, which begins each error
  std::vector<int> slots{};                // joint_ids_map: slot of each joint in LowCmd
  std::vector<std::string> joint_names{};  // understudy.joint_names; may be empty
  float step_dt = 0;                       // s between two steps of the policy
  std::vector<float> stiffness{};          // N·m/rad, by slot
  std::vector<float> damping{};            // N·m·s/rad, by slot
  std::vector<float> default_q{};          // rad
  std::array<Limits, 3> velocity{};        // of commands: forward, left m/s, turn rad/s
  Action action{};
  std::vector<Term> terms{};
  bool scale_first = false;      // scales before it clips
  bool history_by_step = false;  // use_gym_history: all terms of the oldest step come first
  std::filesystem::path weights{};

  std::size_t joints() const { return default_q.size(); }
};

// Reads a definition of at most 1 MiB. Throws ConfigError with file, line, key, what was expected
// and the nearest valid word: for missing keys, unknown terms and actions, numbers that are not
// finite, lists whose lengths do not fit. Keys that the vendor's programs do not read are ignored.
Definition ReadDefinition(const std::filesystem::path& file);

// The same of text, as if it stood in `file`.
Definition ParseDefinition(const std::string& text, const std::filesystem::path& file);

// Returns how many values a term has in one step, and all terms with their histories.
std::size_t Width(const Term& term, const Definition& definition);
std::size_t Width(const Definition& definition);

}  // namespace understudy::policy
