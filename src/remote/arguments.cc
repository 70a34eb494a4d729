#include "remote/arguments.h"

#include <CLI/CLI.hpp>

#include "ctl/check.h"

namespace understudy::remote {

CLI::App* AddRemoteCommand(CLI::App* app, RemoteArguments* arguments) {
  CLI::App* remote =
      app->add_subcommand("remote", "Be the remote controller: keyboard and gamepad");
  client::AddRobotChoice(remote, &arguments->robot);
  remote
      ->add_option("--gamepad", arguments->gamepad,
                   "Which one: a number of --list-gamepads, or part of a name [the first]")
      ->type_name("N|NAME");
  remote
      ->add_option("--mapping", arguments->mapping,
                   "Which button is which of more gamepads, in SDL's form, as in "
                   "gamecontrollerdb.txt")
      ->type_name("FILE");
  remote
      ->add_option("--dead-zone", arguments->dead_zone,
                   "How far of a gamepad's stick is still its middle, 0 to 0.9")
      ->capture_default_str()
      ->check(ctl::NumberWithin(0, 0.9))
      ->type_name("X");
  remote->add_flag("--no-keyboard", arguments->no_keyboard, "Gamepads only, and no picture");
  remote->add_flag("--list-gamepads", arguments->list_gamepads,
                   "Show what is plugged in, and whether its buttons are known");
  remote->footer(
      "Keys: q L1, w L2, p R1, o R2, a b x y, arrows, Enter START, Tab SELECT, 1 F1, 2 F2;\n"
      "e d s f the left stick, i k j l the right one, with shift half the way. Space keeps the "
      "next\n"
      "key down until Space and that key again; Esc lets everything go; Ctrl-C ends.\n"
      "What is held is let go when this program ends, however it ends.\n"
      "Examples:\n"
      "  understudy remote                         of the only robot that runs\n"
      "  understudy remote --name left --gamepad xbox\n"
      "  understudy run go2 --gamepad              robot and gamepad in one\n"
      "Which button is which, and what terminals can tell: docs/remote.md");
  return remote;
}

}  // namespace understudy::remote
