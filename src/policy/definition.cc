#include "policy/definition.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <system_error>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "policy/terms.h"

namespace understudy::policy {
namespace {

constexpr std::uintmax_t kLargestDefinition = std::uintmax_t{1} << 20;  // bytes
constexpr std::size_t kMostJoints = 64;
constexpr float kMostSlot = 255;
constexpr std::size_t kMostHistory = 1000;

// A value of the file with its key and its place, for errors.
class Value {
 public:
  Value(const YAML::Node& node, std::string file, std::string key)
      : node_(node), file_(std::move(file)), key_(std::move(key)) {}

  [[noreturn]] void Fail(const std::string& what) const {
    const YAML::Mark mark = node_.IsDefined() ? node_.Mark() : YAML::Mark::null_mark();
    const std::string line = mark.is_null() ? "" : ":" + std::to_string(mark.line + 1);
    throw ConfigError(file_ + line + (key_.empty() ? "" : ": " + key_) + ": " + what);
  }

  // The value of a key of this mapping; one that is missing or null is not there.
  Value At(const std::string& key) const {
    const std::string path = key_.empty() ? key : key_ + "." + key;
    if (!is_map()) return {YAML::Node(YAML::NodeType::Undefined), file_, path};
    return {node_[key], file_, path};
  }
  Value Need(const std::string& key) const {
    Value value = At(key);
    if (!value.there()) value.FailAt(*this, "missing");
    return value;
  }
  bool there() const { return node_.IsDefined() && !node_.IsNull(); }
  bool is_map() const { return node_.IsDefined() && node_.IsMap(); }
  bool is_list() const { return node_.IsDefined() && node_.IsSequence(); }
  const std::string& key() const { return key_; }

  // The entries of this mapping in their order.
  std::vector<std::pair<std::string, Value>> Entries() const {
    if (!is_map()) Fail("expected a mapping of keys");
    std::vector<std::pair<std::string, Value>> entries;
    for (const auto& entry : node_) {
      const std::string key = Shown(entry.first);
      entries.emplace_back(key, Value(entry.second, file_, key_.empty() ? key : key_ + "." + key));
    }
    return entries;
  }

  std::vector<Value> Items() const {
    if (!is_list()) Fail("expected a list");
    std::vector<Value> items;
    for (std::size_t i = 0; i < node_.size(); ++i) {
      items.emplace_back(node_[i], file_, key_ + "." + std::to_string(i));
    }
    return items;
  }

  float Number() const {
    float number = 0;
    if (!Parse(&number) || !std::isfinite(number)) Fail("expected a number, got " + Shown(node_));
    return number;
  }

  int Whole(int least, int most) const {
    int number = 0;
    if (!Parse(&number) || number < least || number > most) {
      Fail("expected a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
           ", got " + Shown(node_));
    }
    return number;
  }

  bool Flag() const {
    const std::string text = Shown(node_);
    if (text != "true" && text != "false") Fail("expected true or false, got " + text);
    return text == "true";
  }

  std::string Text() const {
    if (!there() || !node_.IsScalar()) Fail("expected a text");
    return Shown(node_);
  }

  std::vector<float> Numbers() const {
    std::vector<float> numbers;
    for (const Value& item : Items()) numbers.push_back(item.Number());
    return numbers;
  }
  std::vector<float> Numbers(std::size_t count, const std::string& of) const {
    std::vector<float> numbers = Numbers();
    if (numbers.size() != count) {
      Fail("expected one number for each of the " + std::to_string(count) + " " + of + ", got " +
           std::to_string(numbers.size()));
    }
    return numbers;
  }
  Limits LeastAndMost() const {
    const std::vector<float> numbers = Numbers();
    if (numbers.size() != 2 || numbers[0] > numbers[1]) Fail("expected [least, most]");
    return {numbers[0], numbers[1]};
  }

 private:
  // As Fail, at the place of the mapping that should have the value.
  [[noreturn]] void FailAt(const Value& owner, const std::string& what) const {
    Value(owner.node_, file_, key_).Fail(what);
  }

  template <class T>
  bool Parse(T* number) const {
    if (!there() || !node_.IsScalar()) return false;
    const std::string& text = node_.Scalar();
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    const auto [parsed, error] = std::from_chars(begin, end, *number);
    return error == std::errc() && parsed == end;
  }

  static std::string Shown(const YAML::Node& node) {
    if (!node.IsDefined() || node.IsNull()) return "nothing";
    if (!node.IsScalar()) return node.IsMap() ? "a mapping" : "a list";
    constexpr std::size_t kLongest = 200;
    std::string text = node.Scalar().substr(0, kLongest);
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '.';
    }
    return text;
  }

  YAML::Node node_;
  std::string file_, key_;
};

std::vector<std::size_t> All(std::size_t joints) {
  std::vector<std::size_t> all(joints);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// The joints that `joint_ids` of a term or action lists. Without a list, and for Python's slice of
// all that the exporter writes as three nulls: all.
std::vector<std::size_t> Joints(const Value& list, std::size_t joints) {
  if (!list.there()) return All(joints);
  const std::vector<Value> items = list.Items();
  const auto there = [](const Value& item) { return item.there(); };
  if (std::ranges::none_of(items, there)) return All(joints);
  std::vector<std::size_t> chosen;
  for (const Value& item : items) {
    chosen.push_back(static_cast<std::size_t>(item.Whole(0, static_cast<int>(joints) - 1)));
    if (std::ranges::count(chosen, chosen.back()) > 1) item.Fail("this joint is listed already");
  }
  return chosen;
}

// One number for all values, one for each, or 1 where there is none.
std::vector<float> Scale(const Value& scale, std::size_t width) {
  if (!scale.there()) return std::vector<float>(width, 1);
  if (!scale.is_list()) return std::vector<float>(width, scale.Number());
  return scale.Numbers(width, "values");
}

Action ReadAction(const Value& actions, const Definition& definition) {
  constexpr const char* kName = "JointPositionAction";
  for (const auto& [name, value] : actions.Entries()) {
    if (name != kName) value.Fail("unknown action" + DidYouMean(name, {kName}));
  }
  const Value given = actions.Need(kName);
  Action action{.joints = Joints(given.At("joint_ids"), definition.joints())};
  const std::size_t count = action.joints.size();
  action.scale = Scale(given.At("scale"), count);
  const Value offset = given.At("offset");
  action.offset =
      offset.there() ? offset.Numbers(count, "actions") : std::vector<float>(count, 0.0F);
  const Value clip = given.At("clip");
  if (!clip.there()) return action;
  for (const Value& limits : clip.Items()) action.clip.push_back(limits.LeastAndMost());
  if (action.clip.size() != count) {
    clip.Fail("expected [least, most] for each of the " + std::to_string(count) + " actions, got " +
              std::to_string(action.clip.size()));
  }
  return action;
}

Term ReadTerm(const std::string& name, const Value& given, const Definition& definition) {
  const std::span<const TermRow> rows = TermRows();
  const auto row = std::ranges::find(rows, name, &TermRow::name);
  if (row == rows.end()) {
    std::vector<std::string> names;
    for (const TermRow& known : rows) names.emplace_back(known.name);
    given.Fail("unknown observation" + DidYouMean(name, names));
  }
  if (given.there() && !given.is_map()) given.Fail("expected a mapping of keys");
  Term term{.row = &*row};
  const Value params = given.At("params");
  if (row->width == TermRow::Width::kJoints) {
    term.joints = Joints(params.At("asset_cfg").At("joint_ids"), definition.joints());
  }
  if (name == "gait_phase") {
    const Value period = params.Need("period");
    term.period = period.Number();
    if (term.period <= 0) period.Fail("expected more than 0 s");
  }
  term.scale = Scale(given.At("scale"), Width(term, definition));
  if (const Value clip = given.At("clip"); clip.there()) term.clip = clip.LeastAndMost();
  if (const Value history = given.At("history_length"); history.there()) {
    // The exporter of other programs writes 0 for the present step alone.
    term.history =
        static_cast<std::size_t>(std::max(history.Whole(0, static_cast<int>(kMostHistory)), 1));
  }
  return term;
}

void ReadTerms(const Value& observations, Definition* definition) {
  Value terms = observations;
  // Terms may stand in one named group.
  const auto groups = observations.Entries();
  const auto is_group = [](const auto& entry) {
    return entry.second.is_map() && !entry.second.At("params").there() &&
           std::ranges::any_of(TermRows(), [&](const TermRow& row) {
             return entry.second.At(std::string(row.name)).is_map();
           });
  };
  if (std::ranges::any_of(groups, is_group)) {
    if (groups.size() != 1) observations.Fail("expected one group of observations, got more");
    terms = groups.front().second;
  }
  for (const auto& [name, value] : terms.Entries()) {
    if (name == "scale_first") {
      definition->scale_first = value.Flag();
    } else if (name == "use_gym_history") {
      definition->history_by_step = value.Flag();
    } else {
      definition->terms.push_back(ReadTerm(name, value, *definition));
    }
  }
  if (definition->terms.empty()) terms.Fail("expected at least one observation");
  const std::size_t history = definition->terms.front().history;
  const auto differs = [&](const Term& term) { return term.history != history; };
  if (definition->history_by_step && std::ranges::any_of(definition->terms, differs)) {
    terms.Fail("use_gym_history needs the same history_length in all terms");
  }
}

void ReadVelocity(const Value& commands, Definition* definition) {
  constexpr std::array kKeys{"lin_vel_x", "lin_vel_y", "ang_vel_z"};
  const bool commanded = std::ranges::any_of(
      definition->terms, [](const Term& term) { return term.row->name == "velocity_commands"; });
  const Value ranges = commands.At("base_velocity").At("ranges");
  if (!commanded && !ranges.there()) return;
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    definition->velocity[i] = ranges.Need(kKeys[i]).LeastAndMost();
  }
}

// The keys that the vendor's file does not have.
void ReadOwn(const Value& own, const std::filesystem::path& file, Definition* definition) {
  definition->weights = std::filesystem::path(file).replace_extension(".safetensors");
  if (!own.there()) return;
  for (const auto& [name, value] : own.Entries()) {
    if (name == "weights") {
      definition->weights = file.parent_path() / value.Text();
    } else if (name == "joint_names") {
      for (const Value& item : value.Items()) definition->joint_names.push_back(item.Text());
      if (definition->joint_names.size() != definition->joints()) {
        value.Fail("expected a name for each of the " + std::to_string(definition->joints()) +
                   " joints of default_joint_pos, got " +
                   std::to_string(definition->joint_names.size()));
      }
    } else {
      value.Fail("unknown key" + DidYouMean(name, {"weights", "joint_names"}));
    }
  }
}

Definition Read(const Value& root, const std::filesystem::path& file) {
  if (!root.is_map()) root.Fail("expected the keys of a policy's definition");
  Definition definition{.name = file.string()};
  const Value step = root.Need("step_dt");
  definition.step_dt = step.Number();
  if (definition.step_dt <= 0 || definition.step_dt > 1)
    step.Fail("expected more than 0, at most 1 s");
  const Value angles = root.Need("default_joint_pos");
  definition.default_q = angles.Numbers();
  if (definition.default_q.empty() || definition.default_q.size() > kMostJoints) {
    angles.Fail("expected 1 to 64 angles, got " + std::to_string(definition.default_q.size()));
  }
  ReadOwn(root.At("understudy"), file, &definition);
  if (const Value map = root.At("joint_ids_map"); map.there()) {
    // Whole numbers, which the exporter may write with a point.
    for (const float slot : map.Numbers(definition.joints(), "joints of default_joint_pos")) {
      if (slot < 0 || slot > kMostSlot || slot != std::floor(slot)) {
        map.Fail("expected slots, which are whole numbers from 0");
      }
      definition.slots.push_back(static_cast<int>(slot));
    }
  } else if (definition.joint_names.empty()) {
    root.Need("joint_ids_map");
  }
  definition.stiffness = root.Need("stiffness").Numbers();
  definition.damping = root.Need("damping").Numbers();
  for (const char* key : {"stiffness", "damping"}) {
    for (const Value& gain : root.At(key).Items()) {
      if (gain.Number() < 0) gain.Fail("expected at least 0");
    }
  }
  definition.action = ReadAction(root.Need("actions"), definition);
  ReadTerms(root.Need("observations"), &definition);
  ReadVelocity(root.At("commands"), &definition);
  return definition;
}

}  // namespace

std::size_t Width(const Term& term, const Definition& definition) {
  switch (term.row->width) {
    case TermRow::Width::kTwo:
      return 2;
    case TermRow::Width::kThree:
      return 3;
    case TermRow::Width::kJoints:
      return term.joints.size();
    case TermRow::Width::kActions:
      break;
  }
  return definition.action.joints.size();
}

std::size_t Width(const Definition& definition) {
  std::size_t width = 0;
  for (const Term& term : definition.terms) width += Width(term, definition) * term.history;
  return width;
}

Definition ParseDefinition(const std::string& text, const std::filesystem::path& file) {
  try {
    return Read(Value(YAML::Load(text), file.string(), ""), file);
  } catch (const YAML::Exception& error) {
    throw ConfigError(file.string() + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
}

Definition ReadDefinition(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size =
      std::filesystem::is_regular_file(file, error) ? std::filesystem::file_size(file, error) : 0;
  std::ifstream stream(file, std::ios::binary);
  if (size == 0 || error || !stream) {
    throw ConfigError(file.string() +
                      ": expected a policy's definition: no such file, or it is empty");
  }
  if (size > kLargestDefinition) throw ConfigError(file.string() + ": expected at most 1 MiB");
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  return ParseDefinition(text, file);
}

}  // namespace understudy::policy
