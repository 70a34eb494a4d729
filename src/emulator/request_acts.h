// What each request does, once it has been read.
#pragma once

#include <string_view>

#include "emulator/request.h"

namespace understudy::emulator {

class Robot;
class World;

// A friend of the world: its table says which of these a request is.
struct RequestActs {
  using Act = Answer(World& world, Robot& robot, Request& request, double t);

  static Act Pause, Resume, Step, SetSpeed, Reset;
  static Act Push, Drag, LetGo, PlaceObject;
  static Act LowerCrane, RaiseCrane, AttachCrane, ReleaseCrane, Clamp;
  static Act SwitchPower, SetFault, Set, MoveJoint;
  static Act PressKeys, HoldKeys, ReleaseKeys, MoveSticks, SetRemote, SwitchRemoteOn,
      SwitchRemoteOff;
  static Act StartRecording, StopRecording, CallService;

 private:
  // Returns the id of the named body, which must be movable; by default the base, whose name is
  // then filled in. The request is then one to the robot that has the body, if any has it.
  static Result<int> BodyOf(const World& world, const Robot& robot, Request* request);

  // Returns when a push or drag that begins at t ends; even the shortest acts in one step.
  static double Until(const World& world, const Request& request, double t);
};

}  // namespace understudy::emulator
