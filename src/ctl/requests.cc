// The verbs of `understudy ctl` that send a request: one per row of the table.
#include <chrono>
#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>

#include "ctl/ask.h"
#include "ctl/command.h"
#include "ctl/text.h"
#include "emulator/request.h"
#include "server/request_docs.h"

namespace understudy::ctl {
namespace {

using emulator::RequestRow;
using nlohmann::json;
using schema::Field;

// The reply to `step` comes when the steps are done, which may take long at a low speed.
constexpr std::chrono::hours kStepPatience{24};

// Returns the JSON value of the words on the command line.
json ValueOf(const Field& field, const std::vector<std::string>& words) {
  if (field.type == &schema::kVector) {
    json numbers = json::array();
    for (const std::string& word : words) numbers.push_back(schema::JsonOfWord(word));
    return numbers;
  }
  // Seen from here, which need not be where the robot was started.
  if (field.type == &emulator::types::kFile)
    return std::filesystem::absolute(words.front()).string();
  if (field.type == &schema::kSwitch && words.front().empty()) return true;
  return field.type->is_text() ? json(words.front()) : schema::JsonOfWord(words.front());
}

// Returns "lower, raise, attach, release": the requests of a group.
std::string VerbsOf(std::string_view group) {
  std::string verbs;
  for (const RequestRow& row : emulator::RequestRows()) {
    if (!row.name.starts_with(std::string(group) + ".")) continue;
    verbs += (verbs.empty() ? "" : ", ") + std::string(row.name.substr(group.size() + 1));
  }
  return verbs;
}

// Replaces invalid UTF-8, so that the robot refuses such a word as an unknown name.
std::string BodyOf(const json& values) {
  return values.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

void CtlCommand::AddRequests(CLI::App* ctl) {
  for (const RequestRow& row : emulator::RequestRows()) {
    CLI::App* parent = ctl;
    const std::size_t dot = row.name.find('.');
    if (dot != std::string_view::npos) {
      const std::string group(row.name.substr(0, dot));
      const auto known = ctl->get_subcommands(
          [&](const CLI::App* command) { return command->get_name() == group; });
      if (!known.empty()) {
        parent = known.front();
      } else {
        parent = ctl->add_subcommand(group, VerbsOf(group));
        parent->require_subcommand(1)->fallthrough();
        const std::string verb = group + " " + std::string(row.name.substr(dot + 1));
        parent->footer("Example: understudy ctl " + std::string(row.example) +
                       "; `understudy ctl " + verb + " --help` says more");
      }
    }
    AddRequest(parent, std::string(row.name.substr(dot + 1)), row);
  }
}

void CtlCommand::AddRequest(CLI::App* parent, const std::string& verb, const RequestRow& row) {
  CLI::App* command = AddAction(parent, verb, std::string(row.does), nullptr);
  command->footer("Example: understudy ctl " + std::string(row.example));
  std::vector<std::string>* const words = words_.emplace_back(row.fields.size()).data();
  for (std::size_t i = 0; i < row.fields.size(); ++i) {
    const Field& field = row.fields[i];
    const std::string name =
        field.bare ? server::Capitals(field.key) : "--" + std::string(field.key);
    std::string help = std::string(field.does) + ": " + schema::Expected(field);
    if (field.otherwise) help += " [" + schema::NumberText(*field.otherwise) + "]";
    const int most = field.type == &schema::kVector ? 3 : 1;
    const bool alone = field.type == &schema::kSwitch && !field.bare;  // it is true then
    command->add_option(name, words[i], help)
        ->expected(alone ? 0 : most, most)
        ->allow_extra_args(false)
        ->required(field.required && row.list.empty())  // alone, such a request lists
        ->type_name("");
  }
  command->callback([this, &row, words] {
    json values = json::object();
    for (std::size_t i = 0; i < row.fields.size(); ++i) {
      if (words[i].empty()) continue;
      values[std::string(row.fields[i].key)] = ValueOf(row.fields[i], words[i]);
    }
    if (values.empty() && !row.list.empty()) {
      action_ = [this, &row] { Show(std::string(row.list), SettingsText); };
      return;
    }
    if (const auto request = emulator::ReadRequest(row, values); !request) {
      const std::string name(row.name);
      std::string why = request.why();  // which begins with a key, and that may be its name
      if (why.starts_with(name + ": ")) why.erase(0, name.size() + 2);
      throw CLI::ValidationError(name, why);
    }
    action_ = [this, &row, values] { Request(row, values); };
  });
}

void CtlCommand::Request(const RequestRow& row, const json& values) const {
  const std::chrono::milliseconds patience = row.name == "step" || row.name == "record.stop"
                                                 ? std::chrono::milliseconds{kStepPatience}
                                                 : kCallTimeout;
  const std::string reply =
      Ask(client::ChosenSocket(robot_), "POST", server::RequestPath(row), BodyOf(values), patience);
  if (json_) *out_ << reply;
}

}  // namespace understudy::ctl
