#include "viewer/window.h"

#include <algorithm>
#include <utility>

#include <GLFW/glfw3.h>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

constexpr int kWindowSamples = 4;  // per pixel

std::string LastError() {
  const char* why = nullptr;
  glfwGetError(&why);
  return why == nullptr ? "no reason given" : why;
}

GLFWwindow* Open(const std::string& title, const PictureSize& size) {
  glfwWindowHint(GLFW_SAMPLES, kWindowSamples);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GLFWwindow* window = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {  // smooth edges are not everywhere to be had
    glfwWindowHint(GLFW_SAMPLES, 0);
    window = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  }
  if (window == nullptr) {
    throw SetupError("no window with OpenGL: " + LastError() + "; `understudy picture` needs none");
  }
  return window;
}

}  // namespace

Window::Library::Library() {
  if (glfwInit() != GLFW_TRUE) {
    throw SetupError("no window: " + LastError() +
                     "; is DISPLAY set? `understudy picture` and the panel need no display");
  }
}

Window::Library::~Library() { glfwTerminate(); }

Window::Window(const std::string& title, const PictureSize& size) : window_(Open(title, size)) {
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    using Kind = WindowEvent::Kind;
    const Kind kind = action == GLFW_PRESS    ? Kind::kKeyDown
                      : action == GLFW_REPEAT ? Kind::kKeyAgain
                                              : Kind::kKeyUp;
    WindowEvent event = Of(window)->At(kind, key);
    event.shift = (mods & GLFW_MOD_SHIFT) != 0;
    event.control = (mods & GLFW_MOD_CONTROL) != 0;
    Of(window)->events_.push_back(event);
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    WindowEvent event = Of(window)->At(
        action == GLFW_PRESS ? WindowEvent::Kind::kButtonDown : WindowEvent::Kind::kButtonUp,
        button);
    event.shift = (mods & GLFW_MOD_SHIFT) != 0;
    event.control = (mods & GLFW_MOD_CONTROL) != 0;
    Of(window)->events_.push_back(event);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double, double) {
    Of(window)->events_.push_back(Of(window)->At(WindowEvent::Kind::kMove, 0));
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
    WindowEvent event = Of(window)->At(WindowEvent::Kind::kScroll, 0);
    event.scroll = notches;
    Of(window)->events_.push_back(event);
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) {
    Of(window)->events_.push_back(Of(window)->At(WindowEvent::Kind::kRedraw, 0));
  });
}

Window::~Window() { glfwDestroyWindow(window_); }

Window* Window::Of(GLFWwindow* window) {
  return static_cast<Window*>(glfwGetWindowUserPointer(window));
}

WindowEvent Window::At(WindowEvent::Kind kind, int code) const {
  WindowEvent event;
  event.kind = kind;
  event.code = code;
  int width = 1;
  int height = 1;
  glfwGetWindowSize(window_, &width, &height);
  glfwGetCursorPos(window_, &event.x, &event.y);
  event.x /= std::max(height, 1);
  event.y /= std::max(height, 1);
  const auto is_down = [this](int key) { return glfwGetKey(window_, key) == GLFW_PRESS; };
  event.shift = is_down(GLFW_KEY_LEFT_SHIFT) || is_down(GLFW_KEY_RIGHT_SHIFT);
  event.control = is_down(GLFW_KEY_LEFT_CONTROL) || is_down(GLFW_KEY_RIGHT_CONTROL);
  return event;
}

std::vector<WindowEvent> Window::Wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
  return std::exchange(events_, {});
}

void Window::Wake() { glfwPostEmptyEvent(); }

void Window::Swap() { glfwSwapBuffers(window_); }

bool Window::closed() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

PictureSize Window::pixels() const {
  PictureSize size{.width = 1, .height = 1};
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  // An iconified window has none.
  return {.width = std::max(size.width, 1), .height = std::max(size.height, 1)};
}

double Window::scale() const {
  float x = 1;
  float y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::max(x, y);
}

}  // namespace understudy::viewer
