#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include "tests/motion/quadruped_rig.h"
using namespace understudy;

static void Show(QuadrupedRig& r, const char* what) {
  auto e = r.rpy();
  auto p=r.world().base().p_WB;
  std::printf("%-14s id %d h %.3f est %.3f xy %.3f %.3f rpy % .3f % .3f % .3f fast %.3f sat %.3f\n", what, r.state().id, r.height(), r.state().body_height, p.x(),p.y(), e.x(), e.y(), e.z(), r.fastest(), r.longest_saturation());
}
static void Dump(QuadrupedRig& r, const std::string& f) {
  std::ofstream o("/tmp/q/" + r.spec().name + "_" + f + ".txt");
  const mjModel& m = r.world().model();
  for (int i = 0; i < m.nq; ++i) o << r.world().data().qpos[i] << "\n";
}
int main(int argc, char** argv) {
  std::string robot = argc > 1 ? argv[1] : "go2";
  std::string what = argc > 2 ? argv[2] : "all";
  QuadrupedRig r(robot);
  if (what == "recover") {
    std::mt19937 g(7);
    std::normal_distribution<double> n; std::uniform_real_distribution<double> u(-1,1);
    int ok = 0; int N = argc > 3 ? atoi(argv[3]) : 20;
    for (int k = 0; k < N; ++k) {
      PoseSpec p = r.spec().lying;
      Eigen::Quaterniond q(n(g), n(g), n(g), n(g)); q.normalize();
      p.quat = {q.w(), q.x(), q.y(), q.z()};
      for (std::size_t i = 0; i < 12; ++i) p.q[i] += 0.8*u(g);
      const mjModel& m = r.world().model();
      for (std::size_t i = 0; i < 12; ++i) { int j = mj_name2id(&m, mjOBJ_JOINT, r.spec().motors[i].joint.c_str()); p.q[i] = std::clamp(p.q[i], m.jnt_range[2*j], m.jnt_range[2*j+1]); }
      p.height = 0.05;
      r.Start(p);
      r.Run(1.0);
      double up0 = std::cos(r.tilt());
      r.Ask(MotionAction::kRecoveryStand);
      bool good = r.RunUntil(1013, 20); r.Run(2);
      good = good && r.tilt() < 0.1 && r.height() > 0.9*r.spec().motion.quadruped.stand_height && r.state().id == 1013;
      ok += good;
      Dump(r, "recover" + std::to_string(k)); std::printf("%d up0 %.2f good %d tilt %.2f h %.3f sat %.2f id %d\n", k, up0, good, r.tilt(), r.height(), r.longest_saturation(), r.state().id);
    }
    std::printf("ok %d of %d\n", ok, N);
    return 0;
  }
  r.StartLying(); r.Run(0.5); Show(r, "lying");
  r.Ask(MotionAction::kStandUp);
  for (int i = 0; i < 6; ++i) { r.Run(0.5); Show(r, "standup"); }
  Dump(r, "lock");
  r.Run(3); Show(r, "lock");
  r.Ask(MotionAction::kBalanceStand); r.Run(0.5); Show(r, "balance"); r.Run(3); Show(r, "balance");
  for (int axis = 0; axis < 3; ++axis) for (double s : {1.0, -1.0}) {
    std::array<double,4> v{}; v[axis] = s * (axis == 2 ? 0.6 : 0.75);
    r.Ask(MotionAction::kEuler, v); r.Run(2.5); Show(r, "euler"); Dump(r, "euler" + std::to_string(axis) + (s>0?"p":"n"));
    r.Ask(MotionAction::kEuler, {0,0,0}); r.Run(2);
  }
  r.Ask(MotionAction::kEuler, {0.75,0.75,0.6}); r.Run(2.5); Show(r, "euler all"); 
  r.Ask(MotionAction::kEuler, {0,0,0}); r.Run(2); Show(r, "level");
  for (double h : {-0.18, 0.03}) { r.Ask(MotionAction::kBodyHeight, {h}); r.Run(2.5); Show(r, "height"); }
  r.Ask(MotionAction::kStopMove); r.Run(2); Show(r, "stop");
  r.Push({r.world().weight()/9.81*3.3*0.1*10, 0, 0}, 0.1); Show(r, "pushed x"); r.Run(2); Show(r, "after");
  r.Push({0, r.world().weight()/9.81*3.3*0.1*10, 0}, 0.1); Show(r, "pushed y"); r.Run(0.3); Show(r, "after"); r.Run(2); Show(r, "after");
  r.Ask(MotionAction::kSit); r.Run(3); Show(r, "sit"); Dump(r, "sit");
  r.Ask(MotionAction::kRiseSit); r.Run(3); Show(r, "risesit");
  r.Ask(MotionAction::kHello); for (int i = 0; i < 12; ++i) { r.Run(0.4); Show(r, "hello"); Dump(r, "hello" + std::to_string(i)); }
  r.Run(2); Show(r, "hello end");
  r.Ask(MotionAction::kStretch); for (int i = 0; i < 6; ++i) { r.Run(0.8); Show(r, "stretch"); Dump(r, "stretch" + std::to_string(i)); }
  r.Run(3); Show(r, "stretch end");
  r.Ask(MotionAction::kPose, {1}); r.Run(2); Show(r, "pose"); Dump(r, "pose"); r.Ask(MotionAction::kPose, {0}); r.Run(2); Show(r, "pose off");
  r.Run(10); Show(r, "10 s");
  r.Ask(MotionAction::kStandUp); r.Run(2); Show(r, "lock");
  r.Run(10); Show(r, "10 s");
  r.Ask(MotionAction::kStandDown); r.Run(4); Show(r, "down");
  r.Ask(MotionAction::kStandUp); r.Run(4); Show(r, "up");
  r.Ask(MotionAction::kDamp); r.Run(3); Show(r, "damp");
  r.Ask(MotionAction::kRecoveryStand); r.Run(8); Show(r, "recovery");
}
