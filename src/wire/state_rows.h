// Makes the rows of states.h.
#pragma once

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "bus/topic.h"
#include "idl/unitree_go.h"
#include "robot/robot_spec.h"
#include "wire/states.h"

namespace understudy::wire {

// A topic with its message type, and its rate [1/s of simulated time].
template <typename Msg>
struct TopicRow {
  bus::Topic<Msg> topic;
  double hz;
};
template <typename Msg>
TopicRow(bus::Topic<Msg>, double)
    -> TopicRow<Msg>;  // Clang deduces none for an aggregate before 17

// Returns the row of a message that `encode` makes (MessagePublication).
template <typename Msg, typename Encode>
StateRow RowOf(std::initializer_list<TopicRow<Msg>> topics, Encode encode) {
  StateRow row;
  for (const TopicRow<Msg>& told : topics) {
    row.topics.push_back({told.topic.name, told.topic.descriptor, told.hz});
  }
  row.open = [topics = row.topics, encode = std::move(encode)](const bus::Participant& participant,
                                                               double timestep) {
    return std::make_unique<MessagePublication<Msg, Encode>>(participant, timestep, topics, encode);
  };
  return row;
}

// Of the families, in go_port.cc and hg_port.cc.
std::vector<StateRow> GoStates(const robot::RobotSpec& spec);
std::vector<StateRow> HgStates(const robot::RobotSpec& spec);

// The rows that both families have with the same type.
StateRow MotionRow(const robot::RobotSpec& spec,
                   const bus::Topic<unitree_go_msg_dds__SportModeState_>& topic,
                   const bus::Topic<unitree_go_msg_dds__SportModeState_>& slow);
StateRow RemoteRow(const robot::RobotSpec& spec);

}  // namespace understudy::wire
