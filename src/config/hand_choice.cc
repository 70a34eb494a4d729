#include "config/hand_choice.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "config/robot_file.h"

namespace understudy::config {
namespace {

using schema::MapOf;
using schema::OneLine;
using schema::ReadYamlFile;
using schema::TakeOut;

constexpr char kNone[] = "none";
constexpr std::string_view kSides[] = {"left", "right"};

struct Choice {
  std::string side;  // "": both
  std::string make;
};

[[noreturn]] void Refuse(const YamlValue& asked, const std::string& why) {
  throw ConfigError(asked.where + ": robot.hand_make: " + why);
}

std::vector<Choice> ChoicesOf(const YamlValue& asked) {
  std::vector<Choice> choices;
  for (std::size_t begin = 0; begin <= asked.text.size();) {
    const std::size_t end = std::min(asked.text.find(',', begin), asked.text.size());
    const std::string one = asked.text.substr(begin, end - begin);
    const std::size_t colon = one.find(':');
    choices.push_back(colon == std::string::npos
                          ? Choice{.side = "", .make = one}
                          : Choice{.side = one.substr(0, colon), .make = one.substr(colon + 1)});
    begin = end + 1;
  }
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const std::string& side = choices[i].side;
    const bool one_side = std::ranges::find(kSides, side) != std::end(kSides);
    if (!one_side && (!side.empty() || choices.size() > 1)) {
      Refuse(asked, "expected left:NAME or right:NAME, got '" + OneLine(asked.text) + "'");
    }
    if (i > 0 && side == choices[0].side) Refuse(asked, "two hands for the " + side + " side");
  }
  return choices;
}

// A hint such as "; g1 bears dex1: understudy run g1 --hands dex1", "" if no robot does.
std::string WhoBears(const std::string& make, const std::filesystem::path& data_dir) {
  for (const std::string& robot : RobotNames(data_dir)) {
    for (const YamlValue& tree : ReadRobotFile(robot, data_dir).trees) {
      const YamlValue* spec = tree.Find("robot");
      const YamlValue* makes = spec == nullptr ? nullptr : spec->Find("hand_makes");
      if (makes == nullptr ||
          std::ranges::find(makes->items, make, &YamlValue::text) == makes->items.end()) {
        continue;
      }
      return "; " + robot + " bears them: understudy run " + robot + " --hands " + make;
    }
  }
  return "";
}

void RequireMake(const YamlValue& asked, const std::string& make,
                 const std::vector<std::string>& makes, const std::filesystem::path& data_dir) {
  if (std::ranges::find(makes, make) != makes.end()) return;
  std::vector<std::string> words = makes;
  words.emplace_back(kNone);
  Refuse(asked, makes.empty()
                    ? "this robot bears no hands, so not '" + OneLine(make) + "' either" +
                          WhoBears(make, data_dir)
                    : "no hands '" + OneLine(make) + "' for this robot" + DidYouMean(make, words));
}

// Removes the texts, or what has them under `key`, of other sides. Names of joints, and of files
// of models, begin with their side. Returns the index of the first that stays.
std::size_t KeepSide(const std::string& side, const char* key, YamlValue* list) {
  const auto is_of = [&](const YamlValue& one) {
    const YamlValue* text = one.kind == YamlValue::Kind::kMap ? one.Find(key) : &one;
    const std::string name =
        text == nullptr ? "" : std::filesystem::path(text->text).filename().string();
    return name.starts_with(side + "_");
  };
  const auto first = std::ranges::find_if(list->items, is_of);
  const auto index = static_cast<std::size_t>(first - list->items.begin());
  std::erase_if(list->items, [&](const YamlValue& one) { return !is_of(one); });
  return index;
}

void Add(const std::string& key, std::size_t number, YamlValue* map) {
  YamlValue entry = MapOf(key, {.kind = YamlValue::Kind::kScalar,
                                .text = std::to_string(number),
                                .items = {},
                                .keys = {},
                                .where = map->where});
  map->keys.push_back(std::move(entry.keys[0]));
  map->items.push_back(std::move(entry.items[0]));
}

using Folders = std::vector<std::filesystem::path>;

// Has each file of `models` replaced by that of its name in the first of `folders`, below
// data_dir/models, that has one.
void TakeOwnModels(const Folders& folders, const std::filesystem::path& data_dir,
                   YamlValue* models) {
  for (YamlValue& model : models->items) {
    const std::filesystem::path name = std::filesystem::path(model.text).filename();
    const auto own = std::ranges::find_if(folders, [&](const std::filesystem::path& folder) {
      return std::filesystem::exists(data_dir / "models" / folder / name);
    });
    if (own != folders.end()) model.text = (*own / name).generic_string();
  }
}

// Adds the hands of a make's file to `hands`, with models of `folders` where they have them.
void AddHands(const Choice& choice, const Folders& folders, const std::filesystem::path& data_dir,
              YamlValue* hands) {
  YamlValue file = ReadYamlFile(data_dir / "config" / "hands" / (choice.make + ".yaml"));
  YamlValue robot = *TakeOut(&file, "robot");
  YamlValue made = *TakeOut(&robot, "hands");
  for (YamlValue& hand : made.items) {
    if (YamlValue* models = hand.Find("models")) TakeOwnModels(folders, data_dir, models);
    YamlValue* motors = hand.Find("motors");
    const std::size_t all = motors->items.size();
    if (!choice.side.empty()) {
      const std::size_t first = KeepSide(choice.side, "joint", motors);
      KeepSide(choice.side, "", hand.Find("models"));
      if (motors->items.empty()) continue;
      if (motors->items.size() < all) {
        Add("slot", first, &hand);
        Add("slots", all, &hand);
      }
    }
    hands->items.push_back(std::move(hand));
  }
}

}  // namespace

YamlValue HandsOf(const YamlValue& asked, const std::vector<std::string>& makes,
                  const std::vector<std::string>& robot_models,
                  const std::filesystem::path& data_dir) {
  YamlValue hands{.kind = YamlValue::Kind::kSequence,
                  .text = {},
                  .items = {},
                  .keys = {},
                  .where = asked.where};
  Folders folders;
  for (const std::string& model : robot_models) {
    folders.push_back(std::filesystem::path(model).parent_path() / "hands");
  }
  for (const Choice& choice : ChoicesOf(asked)) {
    if (choice.make == kNone) continue;
    RequireMake(asked, choice.make, makes, data_dir);
    AddHands(choice, folders, data_dir, &hands);
  }
  return MapOf("robot", MapOf("hands", std::move(hands)));
}

}  // namespace understudy::config
