#include "robot/fault_docs.h"

#include <cctype>
#include <string_view>

#include "base/printed.h"
#include "robot/fault.h"

namespace understudy::robot {
namespace {

constexpr std::string_view kPreface =
    "# Faults\n\n"
    "Written by `understudy faults > docs/reference/faults.md` from the table that carries them "
    "out.\n\n"
    "A fault is a cause: something is wrong with a component of the robot. What follows from it, "
    "follows through the models: a motor's drive lives on its encoder, the motion service on what "
    "sensors say, and error words of the vendor's messages on what a motor's board can know.\n\n"
    "```sh\n"
    "understudy ctl fault FR_calf_joint weak --by 0.3 --for 10\n"
    "understudy ctl fault FR_calf_joint.encoder offset --by 0.1 --ramp 5\n"
    "understudy ctl fault imu off --probability 0.2\n"
    "understudy ctl fault rt/lowstate lost --by 0.3\n"
    "understudy ctl fault rt/api/sport/response delayed --by 0.2\n"
    "understudy ctl fault all none\n"
    "```\n\n"
    "In a script, or in a [scenario](../rehearsing.md):\n\n"
    "```yaml\n"
    "script:\n"
    "  - {at: 3, fault: {component: FR_calf_joint, fault: weak, by: 0.3, for: 10}}\n"
    "  - {at: 8, fault: {component: all, fault: none}}\n"
    "```\n\n"
    "From the start or planned, among the [configuration](config.md) of a run or a scenario; "
    "`understudy check --robot ROBOT` says what of it the robot has not:\n\n"
    "```yaml\n"
    "faults:\n"
    "  - {component: fan.front, fault: off}\n"
    "  - {component: rt/lowcmd, fault: jittery, by: 0.004}\n"
    "  - {component: bus.FR, fault: lost, by: 0.05, at: 20, for: 5}\n"
    "```\n\n"
    "In a world of [several robots](several.md) `ctl --robot NAME` or `robot: NAME` in an event of "
    "a "
    "script says whose; `faults` stands below a robot's name in `robots`.\n\n"
    "The same over HTTP ([requests.md](requests.md)). `for` ends it by itself, with `ramp` its "
    "magnitude grows from nothing, with `probability` it is a loose contact: there or not, drawn "
    "anew for each tenth of a second. What is drawn depends on `sensors.seed` alone, so a run "
    "repeats bit for bit. Topics are those of commands and all on which the robot publishes, the "
    "responses of services among them. Several faults of a component add up; the same one again "
    "begins anew. A reset of the robot takes none away. Each that comes or goes is a line of the "
    "log and an event; what is not in these tables is refused with what is.\n\n"
    "That motors and boards behave so is *assumed*, and so are magnitudes unless given. The error "
    "words are the vendor's: LowState `motor_state[].reserve[0]` of a Go2 has 0x08 for a bus with "
    "too little voltage, 0x10 for a winding that is too hot, 0x20 for an encoder, 0x100 for a "
    "motor that does not answer, which also counts in `lost` and sets 0x80 of `bit_flag`; 0x40 "
    "there is the mainboard's small controller, which reports its temperatures and the fans; "
    "fan_frequency[3] has 0x02 and 0x04 for the fans of the rear right and the front; `motorstate` "
    "of a G1 has 0x8, 0x200, 0x400 and 0x80000000 "
    "([sources.md](../dev/sources.md#developer-pages)). A winding at `robot.thermal.derate_c` "
    "leaves its motor less torque and at `robot.thermal.trip_c` none. A bus whose voltage falls "
    "takes speed and then torque from all motors; a battery that is overloaded or empty cuts off "
    "([fidelity.md](fidelity.md#physics)). Of a parallel pair the joint of pitch stands for motor "
    "B, that of roll for A.\n";

std::string Short(double number) { return Printed("%.4g", number); }

std::string Magnitude(const FaultKind& kind) {
  if (!kind.has_magnitude()) return "";
  const std::string unit = kind.unit.empty() ? "" : " " + std::string(kind.unit);
  return Short(kind.low) + " to " + Short(kind.high) + unit;
}

}  // namespace

std::string FaultsReference() {
  std::string text(kPreface);
  for (std::size_t i = 0; i < kComponents; ++i) {
    const auto of = static_cast<Component>(i);
    std::string title(NameOf(of));
    title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    text += "\n## " + title + "\n\nNamed by " + std::string(NamedAs(of)) +
            ".\n\n| fault | | by | unless given |\n|---|---|---|---|\n";
    for (const FaultKind& kind : FaultKinds()) {
      if (kind.of != of) continue;
      text += "| `" + std::string(kind.name) + "` | " + std::string(kind.does) + " | " +
              Magnitude(kind) + " | " + (kind.has_magnitude() ? Short(kind.otherwise) : "") +
              " |\n";
    }
  }
  return text;
}

}  // namespace understudy::robot
