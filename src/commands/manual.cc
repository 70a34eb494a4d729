// `understudy manual`: the manual pages, made of what --help says.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/errors.h"
#include "base/files.h"
#include "commands/command_path.h"
#include "commands/commands.h"
#include "version.h"

namespace understudy::commands {
namespace {

constexpr char kBrief[] = "simulate a Unitree robot that speaks the robot's own DDS";

// What no help says, for the page of the program itself.
constexpr char kPlaces[] = R"roff(.SH ENVIRONMENT
.TP
.B UNDERSTUDY_CONTROL
The control socket that
.BR understudy\-ctl (1)
and those who look use where neither
.B \-\-name
nor
.B \-\-socket
is given.
.TP
.B UNDERSTUDY_DATA_DIR
Folder with the robots, models, scenarios and the panel, in place of the installed one.
.TP
.B UNDERSTUDY_RUNTIME_DIR
Folder of the control sockets.
.SH FILES
.TP
.I $XDG_RUNTIME_DIR/understudy/NAME.sock
Control socket of the robot NAME, where UNDERSTUDY_RUNTIME_DIR is not set; in
.I /tmp/understudy\-UID
where there is no such folder.
.TP
.I /etc/default/understudy
Options of the robots that systemd starts, as
.B understudy@go2.service
does.
.TP
.I /usr/share/understudy
Robots, models, scenarios, examples and the panel of the Debian package.
)roff";

// A text that stands for itself: roff has meanings for backslashes, quotes, minus signs, and for
// dots and quotes at the beginning of a line.
std::string Plain(std::string_view text) {
  std::string roff;
  for (const char c : text) {
    const bool begins = roff.empty() || roff.back() == '\n';
    if (begins && (c == '.' || c == '\'')) roff += "\\&";
    switch (c) {
      case '\\':
        roff += "\\e";
        break;
      case '-':
        roff += "\\-";
        break;
      case '\'':
        roff += "\\(aq";
        break;
      case '`':
        roff += "\\(ga";
        break;
      case '^':
        roff += "\\(ha";
        break;
      case '~':
        roff += "\\(ti";
        break;
      default:
        roff += c;
    }
  }
  return roff;
}

std::string Bold(std::string_view text) { return "\\fB" + Plain(text) + "\\fR"; }
std::string Italic(std::string_view text) { return "\\fI" + Plain(text) + "\\fR"; }

std::string PageName(const std::string& command) {
  return command.empty() ? "understudy" : "understudy-" + command;
}

// The text at the end of a help, taken apart.
struct Footer {
  std::string prose;     // paragraphs
  std::string examples;  // indented lines, as they are, and their headings
  std::string status;    // what it says of exit codes
};

Footer ReadFooter(const std::string& text) {
  Footer footer;
  std::istringstream lines(text);
  std::string* paragraph = nullptr;  // where the sentence goes on
  bool block = false;                // within indented lines
  const auto end_block = [&] {
    if (block) footer.examples += ".EE\n";
    block = false;
  };
  const auto example = [&](std::string_view line) {
    if (!block) footer.examples += ".PP\n.EX\n";
    block = true;
    footer.examples += Plain(line) + "\n";
    paragraph = nullptr;
  };
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kOne = "Example: ";
    if (line.empty()) continue;
    if (line.starts_with("  ")) {
      example(std::string_view(line).substr(2));
      continue;
    }
    end_block();
    if (line.starts_with(kOne)) {
      example(std::string_view(line).substr(kOne.size()));
    } else if (line == "Examples:") {
      paragraph = nullptr;
    } else if (line.back() == ':') {
      footer.examples += ".PP\n" + Plain(line) + "\n";
      paragraph = nullptr;
    } else {
      const bool status = line.starts_with("Exit") || line.starts_with("The exit");
      std::string* to = status ? &footer.status : paragraph == nullptr ? &footer.prose : paragraph;
      if (to != paragraph) *to += ".PP\n";
      *to += Plain(line) + "\n";
      paragraph = to;
    }
  }
  end_block();
  return footer;
}

// The footer of a command; none if it has only inherited its parent's, as CLI11 has them do.
Footer FooterOf(const CLI::App& command) {
  const std::string text = command.get_footer();
  const CLI::App* parent = command.get_parent();
  return parent != nullptr && parent->get_footer() == text ? Footer() : ReadFooter(text);
}

std::string Usage(const std::string& words, const CLI::App& command) {
  std::string usage = Bold(words) + " [" + Italic("OPTIONS") + "]";
  if (!CommandNames(command).empty()) return usage + " " + Italic("COMMAND");
  for (const CLI::Option* place :
       command.get_options([](const CLI::Option* one) { return one->get_positional(); })) {
    const bool many = place->get_expected_max() >= CLI::detail::expected_max_vector_size;
    const std::string name = Italic(place->get_name(true)) + (many ? "..." : "");
    usage += place->get_required() ? " " + name : " [" + name + "]";
  }
  return usage;
}

std::string Names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + Bold(name);
  return text;
}

// "FILE", or the words to choose from: "{debug,info}".
std::string TypeOf(const CLI::Option& option) {
  if (!option.get_option_text().empty()) return option.get_option_text();
  if (option.get_type_size() == 0) return "";
  const std::string type = option.get_type_name();
  const std::size_t words = type.find(":{");
  return words == std::string::npos ? type.substr(0, type.find(':')) : type.substr(words + 1);
}

std::string Described(const CLI::Option& option) {
  std::string tag;
  if (option.get_positional()) {
    tag = Italic(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) tag += Bold("-" + name) + ", ";
    for (const std::string& name : option.get_lnames()) tag += Bold("--" + name) + ", ";
    tag.resize(tag.size() - 2);
    if (const std::string type = TypeOf(option); !type.empty()) tag += " " + Italic(type);
  }
  std::string text = ".TP\n" + tag + "\n" + Plain(option.get_description()) + "\n";
  if (!option.get_needs().empty()) text += "Needs " + Names(option.get_needs()) + ".\n";
  if (!option.get_excludes().empty()) text += "Not with " + Names(option.get_excludes()) + ".\n";
  return text;
}

// CLI11's name for the options of no other group.
constexpr char kOwnGroup[] = "Options";

std::string Options(const CLI::App& command) {
  std::string places, options, others;
  std::string group = kOwnGroup;
  for (const CLI::Option* option : command.get_options()) {
    const bool own = option->get_group() == kOwnGroup || option->get_group().empty();
    if (!own && option->get_group() != group) {
      group = option->get_group();
      others += ".PP\n" + Plain(group) + ":\n";
    }
    (option->get_positional() ? places : own ? options : others) += Described(*option);
  }
  return places + options + others;
}

// The commands below one, each with all there is to know of it.
std::string Verbs(const CLI::App& command, const std::string& path) {
  std::string text;
  for (const CLI::App* verb : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_group().empty()) continue;
    const std::string words = path.empty() ? verb->get_name() : path + " " + verb->get_name();
    if (!CommandNames(*verb).empty()) {
      text += Verbs(*verb, words);
      continue;
    }
    const Footer footer = FooterOf(*verb);
    text += ".SS " + Usage(words, *verb) + "\n" + Plain(verb->get_description()) + ".\n" +
            footer.prose + Options(*verb) + footer.status + footer.examples;
  }
  return text;
}

std::string Section(const char* title, std::string_view text) {
  if (text.empty()) return "";
  constexpr std::string_view kParagraph = ".PP\n";  // a section is one by itself
  if (text.starts_with(kParagraph)) text.remove_prefix(kParagraph.size());
  return std::string(".SH ") + title + "\n" + std::string(text);
}

// Breaks lines of text, whose ends mean nothing, as manual pages are edited. Requests, the tags
// after .TP and examples stay as they are.
std::string Folded(const std::string& page) {
  constexpr std::size_t kWidth = 76;
  std::istringstream lines(page);
  std::string folded, before;
  bool example = false;
  for (std::string line; std::getline(lines, line); before = line) {
    if (line == ".EX") example = true;
    if (line == ".EE") example = false;
    std::string_view rest = line;
    while (!example && !line.starts_with('.') && before != ".TP" && rest.size() > kWidth) {
      std::size_t space = rest.rfind(' ', kWidth);
      // No line may begin as a request does.
      while (space != std::string_view::npos && rest.substr(space + 1).starts_with('.')) {
        space = space == 0 ? std::string_view::npos : rest.rfind(' ', space - 1);
      }
      if (space == std::string_view::npos || space == 0) break;
      folded += std::string(rest.substr(0, space)) + "\n";
      rest.remove_prefix(space + 1);
    }
    folded += std::string(rest) + "\n";
  }
  return folded;
}

std::string Page(const CLI::App& app, const CLI::App& command) {
  const bool program = &app == &command;
  const std::string words = program ? "understudy" : "understudy " + command.get_name();
  const std::string name = PageName(program ? "" : command.get_name());
  std::string title = name;
  std::ranges::transform(title, title.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const Footer footer = FooterOf(command);

  std::vector<std::string> others;
  std::string commands;
  if (program) {
    for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; })) {
      if (one->get_group().empty()) continue;
      commands += ".TP\n" + Bold(one->get_name()) + "\n" + Plain(one->get_description()) + "\n";
      others.push_back(PageName(one->get_name()));
    }
  } else {
    commands = Verbs(command, "");
    others.push_back(PageName(""));
  }
  std::string see;
  for (const std::string& other : others) {
    see += ".BR " + Plain(other) + " (1)" + (&other == &others.back() ? "\n" : ",\n");
  }
  see += ".PP\nPages of docs/ are installed in share/doc/understudy/docs, beside share/man.\n";
  return Folded(".TH " + Plain(title) + " 1 " + kReleased + " \"understudy " + kVersion +
                "\" \"User Commands\"\n" +
                Section("NAME", Plain(name) + " \\- " +
                                    Plain(program ? kBrief : command.get_description()) + "\n") +
                Section("SYNOPSIS", Usage(words, command) + "\n") +
                Section("DESCRIPTION", Plain(command.get_description()) + (program ? "\n" : ".\n") +
                                           footer.prose) +
                Section("OPTIONS", Options(command)) + Section("COMMANDS", commands) +
                Section("EXIT STATUS", footer.status) + (program ? kPlaces : "") +
                Section("EXAMPLES", footer.examples) + Section("SEE ALSO", see));
}

int WritePages(const CLI::App& app, const std::filesystem::path& folder) {
  MakeFolder(folder);
  WriteFile(folder / (PageName("") + ".1"), Page(app, app));
  for (const std::string& name : CommandNames(app)) {
    WriteFile(folder / (PageName(name) + ".1"), Page(app, *FindCommand(app, name)));
  }
  return 0;
}

}  // namespace

void AddManualCommand(CLI::App* app, Chosen* chosen) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* manual = app->add_subcommand("manual", "Write the manual pages");
  manual->group("");
  manual->add_option("folder", *folder, "Gets understudy.1 and a page for each command")
      ->required();
  manual->callback([=] { *chosen = [=] { return WritePages(*app, *folder); }; });
}

}  // namespace understudy::commands
