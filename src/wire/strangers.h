// Who else on this network has what only one robot may have: a writer of rt/lowstate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/discovery.h"
#include "bus/reader.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy::wire {

// Watches for foreign participants that write rt/lowstate, and tells those that only hold a writer
// from those that send with it: clients on the vendor's C++ library may hold one and never use it
// (far-unitree-sdk 0.1.8 does). A participant is one stranger, however many writers it has.
class StrangerWatch {
 public:
  // Watches and listens from now on. Throws BusError when Cyclone refuses.
  explicit StrangerWatch(const bus::Participant& participant);

  // What is new since the last call, in the order of discovery. Each stranger appears once and
  // speaks for the first time once, until it has gone.
  struct News {
    std::vector<bus::Neighbour> appeared;
    std::vector<bus::Neighbour> spoke;
  };
  // Never blocks. Allocates nothing while no stranger is there.
  News Poll();

  // As of the last Poll.
  std::vector<bus::Neighbour> silent() const { return WhoseSpeech(false); }
  std::vector<bus::Neighbour> speaking() const { return WhoseSpeech(true); }

 private:
  struct Stranger {
    bus::Neighbour who;
    bool speaks = false;
  };

  std::vector<bus::Neighbour> WhoseSpeech(bool speaks) const;
  template <typename Msg>
  void Hear(bus::Reader<Msg>* ear, News* news);

  bus::NeighbourWatch watch_;
  bus::Reader<unitree_go_msg_dds__LowState_> go_;
  bus::Reader<unitree_hg_msg_dds__LowState_> hg_;
  std::vector<Stranger> strangers_;
};

// "A", "A and B", "A, B and C", each as Describe() has it; "" for nobody.
std::string Describe(const std::vector<bus::Neighbour>& neighbours);

}  // namespace understudy::wire
