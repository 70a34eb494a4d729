#include "remote/arguments.h"

#include <CLI/CLI.hpp>

#include "ctl/check.h"

namespace understudy::remote {

CLI::App* AddRemoteCommand(CLI::App* app, RemoteArguments* arguments) {
  CLI::App* remote =
      app->add_subcommand("remote", "Act as the remote controller, by keyboard or gamepad");
  client::AddRobotChoice(remote, &arguments->robot);
  remote
      ->add_option("--gamepad", arguments->gamepad,
                   "Gamepad to use: its number in --list-gamepads, or part of its name [the first]")
      ->type_name("N|NAME");
  remote
      ->add_option("--mapping", arguments->mapping,
                   "Buttons of further gamepads, in SDL's format, as in "
                   "gamecontrollerdb.txt")
      ->type_name("FILE");
  remote
      ->add_option("--dead-zone", arguments->dead_zone,
                   "How far a stick may be from its middle and still count as there, 0 to 0.9")
      ->capture_default_str()
      ->check(ctl::NumberWithin(0, 0.9))
      ->type_name("X");
  remote->add_flag("--no-keyboard", arguments->no_keyboard, "Use gamepads only, and draw nothing");
  remote->add_flag("--list-gamepads", arguments->list_gamepads,
                   "Show what is plugged in, and whether its buttons are known");
  remote->footer(
      "Keys: q L1, w L2, p R1, o R2, a b x y, arrows, Enter START, Tab SELECT, 1 F1, 2 F2;\n"
      "e d s f the left stick, i k j l the right one, half-way with Shift. Space keeps the\n"
      "next key down until you press Space and that key again; Esc releases everything;\n"
      "Ctrl-C ends.\n"
      "Everything is released when this program ends, however it ends.\n"
      "Examples:\n"
      "  understudy remote                         for the only robot that runs\n"
      "  understudy remote --name left --gamepad xbox\n"
      "  understudy run go2 --gamepad              robot and gamepad in one\n"
      "Which button is which, and what a terminal cannot tell: docs/reference/remote.md");
  return remote;
}

}  // namespace understudy::remote
