#include "physics/touch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"
#include "robot/hand_law.h"

namespace understudy::physics {
namespace {

using Weights = std::array<double, Touch::kMostRows>;

// One side of a contact.
struct Press {
  int body = 0;
  Eigen::Vector3d p_W;      // m
  Eigen::Vector3d force_W;  // N, along the normal, on the body
};

// Calls `use` for each side of each contact that has a force and whose body `wanted` wants.
template <typename Wanted, typename Use>
void ForEachPress(const mjModel& model, const mjData& data, Wanted wanted, Use use) {
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    if (contact.efc_address < 0) continue;  // near, and left out of the constraints
    const std::array<int, 2> bodies{model.geom_bodyid[contact.geom1],
                                    model.geom_bodyid[contact.geom2]};
    if (!wanted(bodies[0]) && !wanted(bodies[1])) continue;
    mjtNum wrench[6];  // in the contact's frame, whose first axis leads from geom1 to geom2
    mj_contactForce(&model, &data, i, wrench);
    const Eigen::Vector3d push_W = wrench[0] * mjcf::Vector(contact.frame);
    const Eigen::Vector3d p_W = mjcf::Vector(contact.pos);
    if (wanted(bodies[0])) use(Press{bodies[0], p_W, -push_W});
    if (wanted(bodies[1])) use(Press{bodies[1], p_W, push_W});
  }
}

// Fills in how much each of `count` cells of a side feels of a press at `at`, with the side from
// -half to half. m.
void Weigh(double at, double half, int count, double spread, Weights* weights) {
  for (int i = 0; i < count; ++i) {
    const double off = (at - half * ((2 * i + 1.0) / count - 1)) / spread;
    (*weights)[static_cast<std::size_t>(i)] = std::exp(-off * off / 2);
  }
}

}  // namespace

Touch::Touch(const mjModel& model, const robot::RobotSpec& spec, const std::string& prefix) {
  if (spec.hands.empty()) return;
  hand_of_body_.assign(static_cast<std::size_t>(model.nbody), -1);
  const std::vector<std::string> names = robot::HandNames(spec);
  const auto index_of = [&](const robot::HandSpec& hand, const std::string& element) {
    return static_cast<int>(std::ranges::find(names, robot::HandNameOf(hand, element)) -
                            names.begin());
  };
  const auto id_of = [&](mjtObj type, const std::string& name) {
    return name.empty() ? -1 : mj_name2id(&model, type, (prefix + name).c_str());
  };
  const int base = id_of(mjOBJ_BODY, spec.base_body);
  std::size_t first = 0;
  for (const robot::HandSpec& hand : spec.hands) {
    for (const robot::MotorSpec& motor : hand.motors) {
      AddLinks(model, id_of(mjOBJ_JOINT, motor.joint), base, index_of(hand, motor.joint));
    }
    for (const robot::PadSpec& pad : hand.pads) {
      if (const int site = id_of(mjOBJ_SITE, pad.site); site >= 0) {
        const int body = model.site_bodyid[site];
        pads_.push_back({site, body, first, pad.rows, pad.columns, hand.touch.spread});
        hand_of_body_[static_cast<std::size_t>(body)] = index_of(hand, pad.site);
      }
      first += robot::CellsOf(pad);
    }
  }
}

void Touch::AddLinks(const mjModel& model, int joint, int base, int hand) {
  if (joint < 0) return;
  const int link = model.jnt_bodyid[joint];
  const int bears = model.body_parentid[link];
  const int root = bears == 0 || bears == base ? link : bears;
  hand_of_body_[static_cast<std::size_t>(root)] = hand;
  for (int body = root + 1; body < model.nbody; ++body) {  // parents come before their children
    if (HandOf(model.body_parentid[body]) == hand) {
      hand_of_body_[static_cast<std::size_t>(body)] = hand;
    }
  }
}

void Touch::Read(const mjModel& model, const mjData& data, std::span<float> cells) const {
  std::ranges::fill(cells, 0.0F);
  const auto wanted = [this](int body) { return HandOf(body) >= 0; };
  ForEachPress(model, data, wanted, [&](const Press& press) {
    for (const Pad& pad : pads_) {
      if (pad.body != press.body) continue;
      const mjcf::RotationView R_WS(data.site_xmat + 9 * pad.site);
      const Eigen::Vector3d p =
          R_WS.transpose() * (press.p_W - mjcf::Vector(data.site_xpos + 3 * pad.site));
      const double felt = -R_WS.col(2).dot(press.force_W);
      if (felt <= 0 || std::abs(p.z()) > kReach) continue;
      const mjtNum* half = model.site_size + 3 * pad.site;
      Weights across, down;
      Weigh(p.x(), half[0], pad.columns, pad.spread, &across);
      Weigh(-p.y(), half[1], pad.rows, pad.spread, &down);
      float* cell = &cells[pad.first];
      for (int row = 0; row < pad.rows; ++row) {
        for (int column = 0; column < pad.columns; ++column) {
          *cell++ += static_cast<float>(felt * down[static_cast<std::size_t>(row)] *
                                        across[static_cast<std::size_t>(column)]);
        }
      }
    }
  });
}

void Touch::Forces(const mjModel& model, const mjData& data, std::span<double> hands) const {
  std::ranges::fill(hands, 0.0);
  const auto wanted = [this](int body) { return HandOf(body) >= 0; };
  if (hand_of_body_.empty()) return;
  ForEachPress(model, data, wanted, [&](const Press& press) {
    hands[static_cast<std::size_t>(HandOf(press.body))] += press.force_W.norm();
  });
}

}  // namespace understudy::physics
