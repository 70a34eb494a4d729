#include "viewer/viewer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <GLFW/glfw3.h>
#include <mujoco/mujoco.h>

#include "robot/remote_keys.h"

namespace understudy::viewer {
namespace {

using nlohmann::json;

constexpr int kHz = 60;                  // of snapshots asked for
constexpr double kPullPeriod = 1. / 30;  // s; a drag holds for 0.5 s unless renewed
constexpr double kNoticeTime = 4;        // s that a refusal is to be read
constexpr double kIdle = 0.1;            // s that the window waits for news
constexpr double kSlowest = 1. / 64, kFastest = 64;

constexpr float kGripColor[4] = {0.9F, 0.15F, 0.3F, 0.9F};

mjtFontScale FontScale(double scale) {
  const auto percent = static_cast<int>(50 * std::lround(2 * scale));
  return static_cast<mjtFontScale>(std::clamp(percent, 100, 300));
}

}  // namespace

Viewer::Viewer(const std::filesystem::path& socket, const ViewArguments& arguments)
    : socket_(socket),
      arguments_(arguments),
      window_("Understudy: " + socket.stem().string(), arguments.size),
      stage_(FetchModel(socket), FetchName(socket)),
      camera_([&] {
        stage_.Show(FetchState(socket, stage_.positions()));
        return CameraOperator(stage_, arguments.camera, arguments.size);
      }()),
      show_(arguments.show),
      requests_(socket),
      remote_sender_([this](const nlohmann::json& values) { requests_.Send("remote.set", values); },
                     remote::FirstPress()),
      robot_(socket, kHz, stage_.positions(), [] { Window::Wake(); }) {
  mjr_defaultContext(&context_);
  stage_.visual()->quality.shadowsize = 2048;
  mjr_makeContext(&stage_.model(), &context_, FontScale(window_.scale()));
  mjr_setBuffer(mjFB_WINDOW, &context_);
}

Viewer::~Viewer() { mjr_freeContext(&context_); }

double Viewer::Now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Viewer::Run(const std::function<bool()>& should_stop) {
  while (!close_ && !window_.closed() && !should_stop()) {
    for (const WindowEvent& event : window_.Wait(kIdle)) Take(event);
    TakeStates();
    Pull();
    HoldRemote();
    if (const std::string refusal = requests_.TakeRefusal(); !refusal.empty()) {
      notice_ = refusal;
      notice_until_ = Now() + kNoticeTime;
      dirty_ = true;
    }
    if (!notice_.empty() && Now() > notice_until_) {
      notice_.clear();
      dirty_ = true;
    }
    if (dirty_) Draw();
  }
  if (pulling_) requests_.Send("let_go");
  remote_sender_.LetGo(Now());
}

void Viewer::TakeStates() {
  const std::deque<SceneState> states = robot_.Take(std::chrono::milliseconds(0));
  if (const std::string gone = robot_.gone(); !gone.empty() && states.empty()) {
    dirty_ = dirty_ || notice_ != gone;
    notice_ = gone;
    notice_until_ = Now() + kNoticeTime;
  }
  if (states.empty()) return;
  stage_.Show(states.back());
  real_time_.Add(states.back().time, Now());
  dirty_ = true;
}

void Viewer::Take(const WindowEvent& event) {
  using Kind = WindowEvent::Kind;
  const bool is_key =
      event.kind == Kind::kKeyDown || event.kind == Kind::kKeyAgain || event.kind == Kind::kKeyUp;
  if (playing_remote_ && is_key && event.code != GLFW_KEY_ESCAPE) {
    Play(event);
    return;
  }
  const bool pressed = event.kind == Kind::kKeyDown || event.kind == Kind::kKeyAgain;
  if (pressed) Press(event);
  // Subtracts the time spent drawing, in which events wait, from the time between clicks.
  const bool moved = pointer_.Take(event, window_.aspect(), Now() - drawing_, &stage_, &camera_);
  dirty_ = dirty_ || pressed || moved || event.kind == Kind::kRedraw;
}

void Viewer::Play(const WindowEvent& key) {
  if (key.kind == WindowEvent::Kind::kKeyAgain) return;  // it is down already
  if (key.kind == WindowEvent::Kind::kKeyDown) {
    remote_.Press(key.code, key.shift);
  } else {
    remote_.Release(key.code);
  }
}

bool Viewer::PressShow(int key) {
  struct Row {
    int key;
    bool ShowChoice::*shown;
  };
  constexpr std::array<Row, 5> kRows = {{{GLFW_KEY_C, &ShowChoice::contacts},
                                         {GLFW_KEY_F, &ShowChoice::forces},
                                         {GLFW_KEY_M, &ShowChoice::com},
                                         {GLFW_KEY_J, &ShowChoice::joints},
                                         {GLFW_KEY_X, &ShowChoice::collision}}};
  const auto row =
      std::find_if(kRows.begin(), kRows.end(), [key](const Row& each) { return each.key == key; });
  if (row == kRows.end()) return false;
  show_.*row->shown = !(show_.*row->shown);
  return true;
}

void Viewer::Press(const WindowEvent& key) {
  if (PressShow(key.code)) return;
  switch (key.code) {
    case GLFW_KEY_F1:
      help_ = !help_;
      break;
    case GLFW_KEY_ESCAPE:
      close_ = !playing_remote_;
      playing_remote_ = false;
      remote_.ReleaseAll();
      remote_sender_.LetGo(Now());
      break;
    case GLFW_KEY_Q:
      close_ = true;
      break;
    case GLFW_KEY_R:
      playing_remote_ = true;
      break;
    case GLFW_KEY_SPACE:
      requests_.Send(stage_.state().paused ? "resume" : "pause");
      break;
    case GLFW_KEY_RIGHT:
      requests_.Send("step", {{"steps", key.shift ? 20 : 1}, {"wait", false}});
      break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      ChangeSpeed(2);
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      ChangeSpeed(0.5);
      break;
    case GLFW_KEY_BACKSPACE:
      requests_.Send("reset");
      break;
    case GLFW_KEY_T:
      FollowOrNot();
      break;
    case GLFW_KEY_V:
      camera_ = CameraOperator(stage_, arguments_.camera, window_.pixels());
      break;
    case GLFW_KEY_LEFT_BRACKET:
      ChangeCamera(-1);
      break;
    case GLFW_KEY_RIGHT_BRACKET:
      ChangeCamera(1);
      break;
    default:
      break;
  }
}

void Viewer::ChangeSpeed(double factor) {
  const double now = stage_.state().speed > 0 ? stage_.state().speed : kFastest;
  requests_.Send("speed", {{"speed", std::clamp(now * factor, kSlowest, kFastest)}});
}

void Viewer::ChangeCamera(int by) {
  const int cameras = stage_.model().ncam;
  mjvCamera* camera = camera_.camera();
  // The free one and the model's, in a ring.
  const int now = camera->type == mjCAMERA_FIXED ? camera->fixedcamid + 1 : 0;
  const int next = (now + by + cameras + 1) % (cameras + 1);
  camera->type = next == 0 ? mjCAMERA_FREE : mjCAMERA_FIXED;
  camera->fixedcamid = next - 1;
}

void Viewer::FollowOrNot() {
  const int wanted = pointer_.selected() > 0 ? pointer_.selected() : stage_.root();
  camera_.Track(stage_, camera_.tracked() == wanted ? -1 : wanted);
}

void Viewer::Pull() {
  const std::optional<Grip>& grip = pointer_.grip();
  if (!grip) {
    if (pulling_) requests_.Send("let_go");
    pulling_ = false;
    return;
  }
  if (pulling_ && Now() - pulled_at_ < kPullPeriod) return;
  const char* name = mj_id2name(&stage_.model(), mjOBJ_BODY, grip->body);
  if (name == nullptr) return;
  requests_.Send("drag", {{"body", name}, {"at", grip->at}, {"to", grip->to}});
  pulling_ = true;
  pulled_at_ = Now();
}

void Viewer::HoldRemote() {
  if (!playing_remote_) return;
  const double asked = stage_.state().speed > 0 ? stage_.state().speed : kFastest;
  remote_sender_.set_speed(std::max(asked, real_time_.value()));
  remote_sender_.Hold(remote_.Read(), Now());
}

void Viewer::DrawGrip() {
  const std::optional<Grip>& grip = pointer_.grip();
  if (!grip) return;
  stage_.AddLine(stage_.InWorld(grip->body, grip->at), grip->to, kGripColor);
}

void Viewer::DrawText(const mjrRect& whole) {
  const TextBlock status = StatusText(stage_.state(), real_time_.value(), requests_.motors());
  mjr_overlay(mjFONT_NORMAL, mjGRID_TOPLEFT, whole, status.left.c_str(), status.right.c_str(),
              &context_);
  if (playing_remote_) {
    mjr_overlay(mjFONT_NORMAL, mjGRID_TOPRIGHT, whole,
                "The keyboard is the remote controller.\n"
                "sticks: E D S F, I K J L   pad: arrows   A B X Y\n"
                "L1 Q  L2 W  R1 P  R2 O  START Enter  SELECT Tab  F1 1  F2 2\n"
                "Esc ends it",
                nullptr, &context_);
  }
  if (help_) {
    const TextBlock help = HelpText();
    mjr_overlay(mjFONT_NORMAL, mjGRID_BOTTOMLEFT, whole, help.left.c_str(), help.right.c_str(),
                &context_);
  } else {
    mjr_overlay(mjFONT_NORMAL, mjGRID_BOTTOMLEFT, whole, "F1", "help", &context_);
  }
  if (!notice_.empty()) {
    mjr_overlay(mjFONT_NORMAL, mjGRID_BOTTOMRIGHT, whole, notice_.c_str(), nullptr, &context_);
  }
}

void Viewer::Draw() {
  const double now = Now();
  const PictureSize size = window_.pixels();
  const mjrRect whole{0, 0, size.width, size.height};
  camera_.Follow(stage_, now - drawn_at_);
  drawn_at_ = now;
  const mjvPerturb selection = pointer_.selection();
  stage_.Compose(camera_.camera(), show_, &selection);
  DrawGrip();
  context_.shadowClip = static_cast<float>(stage_.shadow_reach());
  mjr_render(whole, stage_.scene(), &context_);
  DrawText(whole);
  window_.Swap();
  drawing_ += Now() - now;
  dirty_ = false;
}

}  // namespace understudy::viewer
