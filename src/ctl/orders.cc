// The subcommands of `understudy ctl` that give orders.
#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>

#include "ctl/ask.h"
#include "ctl/check.h"
#include "ctl/command.h"
#include "server/order_json.h"

namespace understudy::ctl {
namespace {

using nlohmann::json;
using std::chrono::steady_clock;

constexpr double kShove = 0.1;  // s that a push lasts unless told otherwise; *assumed*
// While steps are made: how often to look, and how long a robot may make none until it is asked
// what it waits for.
constexpr std::chrono::milliseconds kStepPoll{5};
constexpr std::chrono::seconds kNoStep{5};

json Vector(const std::vector<double>& vector) { return {vector[0], vector[1], vector[2]}; }

}  // namespace

void CtlCommand::AddPace(CLI::App* ctl) {
  AddAction(ctl, "pause", "Let simulated time stand still",
            [this] {
              GiveOrder("/pause", {{"on", true}});
            })
      ->footer(
          "Nothing is sent while it stands still; orders and services go on being answered.\n"
          "Example: understudy ctl pause; understudy ctl step 10; understudy ctl resume");
  AddAction(ctl, "resume", "Let it go on", [this] {
    GiveOrder("/pause", {{"on", false}});
  })->footer("Example: understudy ctl resume");

  CLI::App* step =
      AddAction(ctl, "step", "Make steps of a paused robot, and return when they are made",
                [this] { MakeSteps(); });
  step->add_option("N", steps_, "How many, of 1 ms unless configured")
      ->capture_default_str()
      ->check(NumberWithin(1, static_cast<double>(server::kMostSteps)));
  step->footer("Example: understudy ctl step 1000           a second, at the speed that is set");

  CLI::App* speed = AddAction(ctl, "speed", "Set how fast simulated time goes", [this] {
    GiveOrder("/speed", {{"speed", speed_}});
  });
  speed->add_option("X", speed_, "Simulated seconds per wall second, or max")
      ->required()
      ->transform(SpeedWord());
  speed->footer(
      "Examples:\n"
      "  understudy ctl speed 0.1                slow motion\n"
      "  understudy ctl speed max                as fast as possible");
}

void CtlCommand::AddReset(CLI::App* ctl) {
  CLI::App* reset = AddAction(ctl, "reset", "Back to the start pose, or to another", [this] {
    GiveOrder("/reset", pose_.empty() ? json::object() : json{{"pose", pose_}});
  });
  reset->add_option("POSE", pose_, "lying, standing, hanging or clamped [the start pose]")
      ->check(OneOf({robot::kStartPoses.begin(), robot::kStartPoses.end()}));
  reset->footer("Example: understudy ctl reset hanging");
}

void CtlCommand::AddClamp(CLI::App* ctl) {
  CLI::App* clamp = ctl->add_subcommand("clamp", "Hold the base where it is, or let it go");
  clamp->require_subcommand(1)->fallthrough();
  clamp->footer("Example: understudy ctl clamp on");
  AddAction(clamp, "on", "Hold the base", [this] { GiveOrder("/clamp", {{"on", true}}); });
  AddAction(clamp, "off", "Let the base go", [this] { GiveOrder("/clamp", {{"on", false}}); });
}

void CtlCommand::AddPush(CLI::App* ctl) {
  CLI::App* push =
      AddAction(ctl, "push", "Push a body with a force, world axes, for a time", [this] {
        const double seconds = seconds_ > 0 ? seconds_ : kShove;
        GiveOrder("/push", {{"body", body_}, {"force", vector_}, {"seconds", seconds}});
      });
  push->add_option("BODY", body_, "A body of the model, such as base_link")->required();
  push->add_option("FORCE", vector_, "FX FY FZ in N")
      ->required()
      ->expected(3)
      ->check(NumberWithin(-server::kMostForce, server::kMostForce));
  push->add_option("--for", seconds_, "Simulated seconds that it acts [0.1]")
      ->check(NumberWithin(0.0001, server::kMostSeconds));
  push->footer(
      "Examples:\n"
      "  understudy ctl push base_link 100 0 0 --for 0.2\n"
      "  understudy ctl push torso_link 0 -60 0        for 0.1 s, to the right");
}

void CtlCommand::AddDrag(CLI::App* ctl) {
  CLI::App* drag =
      AddAction(ctl, "drag", "Drag a body to a point in the world", [this] { Drag(); });
  drag->add_option("BODY", body_, "A body of the model, such as base_link");
  drag->add_option("TO", vector_, "X Y Z in the world, m")
      ->expected(3)
      ->check(NumberWithin(-server::kFarthestInWorld, server::kFarthestInWorld));
  drag->add_option("--at", at_,
                   "X Y Z of the point that is dragged, in the body's frame, m [0 0 0]")
      ->expected(3)
      ->check(NumberWithin(-server::kFarthestOnBody, server::kFarthestOnBody));
  drag->add_option("--for", seconds_, "Simulated seconds that it lasts [0.5]")
      ->check(NumberWithin(0.0001, server::kLongestDrag));
  drag->add_flag("--release", release_, "Let go of BODY, or of all");
  drag->footer(
      "A spring as strong as the mass that hangs on the body; again within its time renews it.\n"
      "Examples:\n"
      "  understudy ctl drag base_link 0 0 0.6 --for 5\n"
      "  understudy ctl drag FR_foot 0.4 -0.2 0.2 --at 0 0 -0.02\n"
      "  understudy ctl drag --release");
  drag->callback([this] {
    const bool whole = !body_.empty() && !vector_.empty();
    if (!release_ && !whole) throw CLI::RequiredError("BODY X Y Z, or --release");
    if (release_ && !vector_.empty()) throw CLI::ExcludesError("X Y Z", "--release");
    action_ = [this] { Drag(); };
  });
}

void CtlCommand::AddRemote(CLI::App* ctl) {
  CLI::App* remote = ctl->add_subcommand("remote", "Use the remote controller");
  remote->require_subcommand(1)->fallthrough();
  remote->footer(
      "Keys: R1 L1 START SELECT R2 L2 F1 F2 A B X Y UP RIGHT DOWN LEFT, joined by +.\n"
      "Examples:\n"
      "  understudy ctl remote press L2+B          damping\n"
      "  understudy ctl remote stick ly=0.5 --for 2\n"
      "  understudy ctl remote off                 as if it were not there");
  const auto add_keys = [&](const char* name, const char* help) {
    CLI::App* action = AddAction(remote, name, help, [this, name] {
      nlohmann::json order{{name, keys_}};
      if (seconds_ > 0) order["seconds"] = seconds_;
      GiveOrder("/remote", order);
    });
    action->add_option("KEYS", keys_, "As in L2+B")->required();
    return action;
  };
  const auto add_time = [&](CLI::App* action, const char* help) {
    action->add_option("--for", seconds_, help)->check(NumberWithin(0, server::kMostSeconds));
  };
  add_time(add_keys("press", "Press keys together and let them go"),
           "Simulated seconds that they stay down [0.1]");
  add_keys("hold", "Hold keys until `release`");
  add_keys("release", "Let keys go");
  CLI::App* stick = AddAction(remote, "stick", "Move sticks", [this] { MoveSticks(); });
  stick->add_option("AXIS=VALUE", axes_, "lx, ly, rx or ry, from -1 to 1")->required();
  add_time(stick, "Simulated seconds after which they come back to the middle [never]");
  AddAction(remote, "on", "Switch it on", [this] { GiveOrder("/remote", {{"on", true}}); });
  AddAction(remote, "off", "Switch it off", [this] { GiveOrder("/remote", {{"on", false}}); });
}

void CtlCommand::AddCrane(CLI::App* ctl) {
  CLI::App* crane = ctl->add_subcommand("crane", "Work the crane");
  crane->require_subcommand(1)->fallthrough();
  crane->footer(
      "Examples:\n"
      "  understudy ctl crane lower 0.2          at crane.speed, 0.1 m/s unless configured\n"
      "  understudy ctl crane release            the robot drops");
  const CLI::Validator length = NumberWithin(-server::kMostCraneOrder, server::kMostCraneOrder);
  AddAction(crane, "lower", "Pay out M metres",
            [this] {
              GiveOrder("/crane", {{"lower", metres_}});
            })
      ->add_option("M", metres_, "Metres")
      ->required()
      ->check(length);
  AddAction(crane, "raise", "Take in M metres",
            [this] {
              GiveOrder("/crane", {{"raise", metres_}});
            })
      ->add_option("M", metres_, "Metres")
      ->required()
      ->check(length);
  AddAction(crane, "attach", "Hang the robot where it is", [this] {
    GiveOrder("/crane", {{"attach", true}});
  });
  AddAction(crane, "release", "Let the robot off the hook", [this] {
    GiveOrder("/crane", {{"release", true}});
  });
}

// Returns once the robot has made them, so that whoever reads on reads what they led to.
void CtlCommand::MakeSteps() const {
  const std::filesystem::path socket = client::ChosenSocket(robot_);
  const auto made = [&] {
    try {
      return json::parse(Ask(socket, "GET", "/status", "")).at("steps").get<std::int64_t>();
    } catch (const json::exception& error) {
      throw NotOurVersion(error);
    }
  };
  const std::int64_t before = made();
  const std::string reply = Ask(socket, "POST", "/step", json{{"steps", steps_}}.dump());
  std::int64_t now = before;
  for (auto moved = steady_clock::now(); now < before + steps_;) {
    std::this_thread::sleep_for(kStepPoll);
    if (const std::int64_t newest = made(); newest != now) {
      now = newest;
      moved = steady_clock::now();
    }
    if (steady_clock::now() > moved + kNoStep) {
      throw ControlError("the robot made " + std::to_string(now - before) + " of " +
                         std::to_string(steps_) + " steps and stopped");
    }
  }
  if (json_) *out_ << reply;
}

void CtlCommand::Drag() const {
  json order = json::object();
  if (!body_.empty()) order["body"] = body_;
  if (release_) {
    order["release"] = true;
  } else {
    order["to"] = Vector(vector_);
    if (!at_.empty()) order["at"] = Vector(at_);
    if (seconds_ > 0) order["seconds"] = seconds_;
  }
  GiveOrder("/drag", order);
}

void CtlCommand::MoveSticks() const {
  json sticks = json::object();
  for (const std::string& axis : axes_) {
    const std::size_t equals = axis.find('=');
    double value = 0;
    if (equals == std::string::npos || !CLI::detail::lexical_cast(axis.substr(equals + 1), value)) {
      throw ControlError("expected AXIS=VALUE, as in ly=0.5, got " + axis);
    }
    sticks[axis.substr(0, equals)] = value;
  }
  GiveOrder("/remote", {{"sticks", sticks}, {"seconds", seconds_}});
}

}  // namespace understudy::ctl
