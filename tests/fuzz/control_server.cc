#include "tests/fuzz/control_server.h"

#include <cstdlib>

#include "emulator/status.h"
#include "server/server.h"
#include "tests/support/control.h"

namespace understudy::test {
namespace {

// Never destroyed: a fuzzer ends by exit().
struct Robot {
  TemporaryFolder folder;
  emulator::StatusBoard board;
  emulator::Inbox inbox;
  emulator::SnapshotMailbox snapshots{emulator::Snapshot{}};
  emulator::EventRing events;
  Ticking ticking{&inbox, [](const emulator::Request&) { return emulator::Answer{}; }};
  Showing showing{&snapshots};
  server::ControlServer server{folder.path() / "s",
                               {.identity = {.robot = "go2"},
                                .board = &board,
                                .inbox = &inbox,
                                .snapshots = &snapshots,
                                .events = server::EventHistory(&events)}};
};

}  // namespace

void TellServer(std::string_view bytes) {
  static Robot* const robot = [] {
    auto* made = new Robot;
    std::atexit([] { RemoveTemporaryFolders(); });
    return made;
  }();
  const RawSocket client(robot->server.socket());
  client.Send(bytes);
  client.HangUp();
  // How long an answer may take is libFuzzer's -timeout to judge, not the socket's patience.
  for (bool ended = false; !ended;) {
    try {
      client.ReceiveAll();
      ended = true;
    } catch (const std::exception&) {
    }
  }
}

}  // namespace understudy::test
