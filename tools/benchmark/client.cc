#include "client.h"

#include <filesystem>

#include "bus/writer.h"
#include "config/data_dir.h"
#include "config/load.h"

namespace understudy::bench {
namespace {

constexpr std::chrono::seconds kLong(1);

template <typename Family>
[[noreturn]] void Echo(const bus::Participant& participant) {
  using LowCmd = typename Family::LowCmd;
  using LowState = typename Family::LowState;
  WaitingReader<LowCmd> pings(participant, {"bench/ping", Family::kLowCmd.descriptor});
  bus::Writer<LowState> pongs(participant, {"bench/pong", Family::kLowState.descriptor});
  LowState pong{};
  while (true) {
    pings.Wait(kLong);
    pings.Take([&](const LowCmd& ping, bus::WriterHandle) {
      pong.tick = ping.crc;
      pongs.Write(pong);
    });
  }
}

template <typename Family>
[[noreturn]] void Listen(const bus::Participant& participant) {
  using LowState = typename Family::LowState;
  WaitingReader<LowState> states(participant, Family::kLowState);
  while (true) {
    states.Wait(kLong);
    states.Take([](const LowState&, bus::WriterHandle) {});
  }
}

}  // namespace

std::vector<std::string> HelperArguments(const std::string& helper, const std::string& robot) {
  return {std::filesystem::read_symlink("/proc/self/exe"), "--helper", helper, "--robot", robot};
}

void RunHelper(const std::string& helper, const std::string& robot) {
  const bool go = config::LoadConfig({.robot = robot}, config::DataDir()).robots[0].spec.family ==
                  robot::WireFamily::kGo;
  const bus::Participant participant("lo", 0);
  if (helper == "listen") go ? Listen<GoFamily>(participant) : Listen<HgFamily>(participant);
  go ? Echo<GoFamily>(participant) : Echo<HgFamily>(participant);
}

}  // namespace understudy::bench
