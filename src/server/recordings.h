// Shows the recordings of a folder, and the robot's poses in one of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/request.h"
#include "physics/scene_reader.h"
#include "record/mcap_reader.h"
#include "server/http.h"

namespace understudy::server {

// Why a client of the network may not ask for `request`; "" if it may. A recording's file is named
// plainly there, and so lies in the folder in which the robot was started.
std::string RefusedOverTcp(const emulator::Request& request);

// Finished recordings of `understudy run --record` and `record.start` in one folder, by their name
// there: letters, digits, ".", "-" and "_", then ".mcap". Nothing else of the folder, nor what is
// outside of it, can be reached, not through links either. For the server's thread, which reads two
// seconds of a Go2 in some 20 ms.
class Recordings {
 public:
  // `scene` is that of `robot`, whose poses are asked for; it must outlive this, null: none.
  // Without a folder there are no recordings.
  explicit Recordings(std::filesystem::path folder = {}, physics::SceneReader* scene = nullptr,
                      std::string robot = "")
      : folder_(std::move(folder)), scene_(scene), robot_(std::move(robot)) {}

  // {"folder": "/home/ann", "recordings": [{"name": "go2.mcap", "bytes": 9000, "written": 1.8e9}]},
  // newest first, kMost at most; `written` in s since 1970. One that cannot be played here has also
  // "why_not", as far as that is found in a moment; later calls know more. Of a file that has not
  // changed it is known.
  HttpReply List();

  // {"from": 0, "to": 12.5} [s, simulated]. With from=, to= and hz= in the query also "times" and
  // by time "bodies", poses as in a snapshot: at most `hz` a second of at most kLongest s. 404 for
  // a name that is none, 400 for a wrong query, 409 for a file that is not finished, damaged, or of
  // another robot.
  HttpReply Show(const HttpRequest& request, std::string_view name) const;

  static constexpr std::size_t kMost = 200;  // *assumed*, as the next
  static constexpr double kLongest = 10;     // s

 private:
  struct Seen {
    double written = 0;
    std::uintmax_t bytes = 0;
    std::string why_not;
  };

  // Both "" for one of this robot.
  std::string WhyNotPlayed(const std::filesystem::path& file) const;
  std::string OtherRobot(const std::filesystem::path& file, const record::McapReader& reader) const;

  std::map<std::string, Seen> seen_;  // by name, as the last list had them
  std::filesystem::path folder_;
  physics::SceneReader* scene_;
  std::string robot_;
};

}  // namespace understudy::server
