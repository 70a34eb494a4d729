// Opens a window with OpenGL and reports its mouse and keyboard events.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/arguments.h"

struct GLFWwindow;

namespace understudy::viewer {

struct WindowEvent {
  enum class Kind { kKeyDown, kKeyAgain, kKeyUp, kButtonDown, kButtonUp, kMove, kScroll, kRedraw };

  Kind kind = Kind::kRedraw;
  int code = 0;  // of the key or button, GLFW's
  bool shift = false;
  bool control = false;
  double x = 0, y = 0;  // of the pointer, from the top left corner, in window heights
  double scroll = 0;    // notches, positive away from the user
};

class Window {
 public:
  // Opens the window and makes its OpenGL context current in this thread, which must be the main
  // one. Throws SetupError if there is no display or no OpenGL.
  Window(const std::string& title, const PictureSize& size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Returns the events since the last call; waits up to `seconds` for the first.
  std::vector<WindowEvent> Wait(double seconds);
  // Ends Wait() early. For any thread.
  static void Wake();
  void Swap();

  bool closed() const;
  PictureSize pixels() const;  // of the framebuffer; more than the window's on high-density screens
  double scale() const;        // scale of text
  double aspect() const { return static_cast<double>(pixels().width) / pixels().height; }

 private:
  struct Library {  // GLFW itself
    Library();
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
  };

  WindowEvent At(WindowEvent::Kind kind, int code) const;
  static Window* Of(GLFWwindow* window);

  Library library_;
  GLFWwindow* window_;
  std::vector<WindowEvent> events_;
};

}  // namespace understudy::viewer
