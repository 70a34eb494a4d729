#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/exit_code.h"
#include "base/signals.h"
#include "bus/participant.h"
#include "commands/commands.h"
#include "doctor/examine.h"
#include "doctor/report.h"

namespace understudy::commands {
namespace {

struct DoctorArguments {
  doctor::Question question;
  std::vector<int> domains{0};
  std::string messages = "go";
  int robots = -1;  // not given
  bool echo = false;
  std::string name;
  bool json = false;
};

std::string HostName() {
  char name[256] = "";
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string CheckSeconds(const std::string& text) {
  constexpr double kShortest = 0.1, kLongest = 3600;
  double seconds = 0;
  const bool number = CLI::detail::lexical_cast(text, seconds);
  if (number && seconds >= kShortest && seconds <= kLongest) return {};  // not for NaN
  return "expected seconds from 0.1 to 3600, found '" + text + "'";
}

int EchoCommand(const DoctorArguments& arguments) {
  const doctor::EchoOptions options{.interface = arguments.question.interface,
                                    .domain = arguments.domains.front(),
                                    .name = arguments.name.empty() ? HostName() : arguments.name};
  const auto ready = [](const doctor::EchoOptions& at) {
    std::printf("%s answers on %s, domain %d; Ctrl-C ends it\n", at.name.c_str(),
                at.interface.c_str(), at.domain);
    std::fflush(stdout);
  };
  const auto ready_json = [](const doctor::EchoOptions& at) {
    const nlohmann::ordered_json line = {
        {"name", at.name}, {"interface", at.interface}, {"domain", at.domain}};
    std::puts(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    std::fflush(stdout);
  };
  if (arguments.json) {
    doctor::Echo(options, ready_json);
  } else {
    std::printf("answered %llu messages\n",
                static_cast<unsigned long long>(doctor::Echo(options, ready)));
  }
  return static_cast<int>(ExitCode::kOk);
}

int DoctorCommand(const DoctorArguments& arguments) {
  CatchStopSignals();
  if (arguments.echo) return EchoCommand(arguments);
  doctor::Question question = arguments.question;
  question.hg = arguments.messages == "hg";
  if (arguments.robots >= 0) question.robots = arguments.robots;
  const bool several = arguments.domains.size() > 1;
  bool wrong = false;
  std::string report;
  for (const int domain : arguments.domains) {
    question.domain = domain;
    const auto results = doctor::Judge(doctor::Examine(question));
    wrong = wrong || doctor::AnyWrong(results);
    if (several && arguments.json) report += report.empty() ? "[" : ",";
    if (several && !arguments.json) report += "domain " + std::to_string(domain) + "\n";
    report += arguments.json ? doctor::ReportJson(question, results) : doctor::ReportText(results);
  }
  if (several && arguments.json) report += "]\n";
  std::fputs(report.c_str(), stdout);
  return static_cast<int>(wrong ? ExitCode::kUnfit : ExitCode::kOk);
}

}  // namespace

void AddDoctorCommand(CLI::App* app, Chosen* chosen) {
  const auto arguments = std::make_shared<DoctorArguments>();
  CLI::App* doctor = app->add_subcommand(
      "doctor", "Say what is wrong with machine and network, and what to do about it");
  doctor->add_option("--interface", arguments->question.interface, "Network interface [lo]")
      ->type_name("NAME");
  doctor
      ->add_option("--domain", arguments->domains,
                   "DDS domain; given again, one after the other, as of several robots [0]")
      ->type_name("N")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(CLI::Range(0, bus::kLastDomain));
  doctor->add_option("--seconds", arguments->question.seconds, "How long to measure [3]")
      ->type_name("S")
      ->check(CheckSeconds);
  CLI::Option* const peer =
      doctor
          ->add_option("--peer", arguments->question.peer,
                       "Measure the round trip to the echo on that host: its address or name")
          ->type_name("HOST");
  doctor
      ->add_option("--messages", arguments->messages,
                   "Family of robots: the messages of the round trip are as large as its LowCmd "
                   "and LowState [go]")
      ->check(CLI::IsMember({"go", "hg"}))
      ->needs(peer);
  doctor
      ->add_option("--robots", arguments->robots,
                   "How many robots should be on the network: 0 before a rehearsal, 1 before a "
                   "test with one")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  CLI::Option* const echo = doctor->add_flag("--echo", arguments->echo,
                                             "Answer the doctor on another machine, until Ctrl-C");
  doctor->add_option("--as", arguments->name, "Name of the echo, for --peer [the host's]")
      ->type_name("NAME")
      ->needs(echo);
  echo->excludes(peer);
  doctor->add_flag("--json", arguments->json, "As one JSON document");
  doctor->footer(
      "Prints a line for each check: ok, warning, wrong or not seen; what was found; what to do.\n"
      "It sends nothing on the vendor's topics, so that it can be used beside a live robot.\n"
      "Examples:\n"
      "  understudy doctor                                  before a rehearsal on this machine\n"
      "  understudy doctor --interface eth0 --robots 1      before a test with a robot on a cable\n"
      "  understudy doctor --interface eth0 --echo --as far    on another machine, and then here:\n"
      "  understudy doctor --interface eth0 --peer far      round trip, loss, firewalls, "
      "multicast\n"
      "  understudy doctor --json --seconds 1               for scripts\n"
      "  understudy doctor --robots 1 --domain 0 --domain 1    beside `run go2 g1`\n"
      "Exits with 12 if something is wrong, 0 if nothing is; warnings do not count.\n"
      "docs/reference/doctor.md explains each check.");
  doctor->callback([=] { *chosen = [=] { return DoctorCommand(*arguments); }; });
}

}  // namespace understudy::commands
