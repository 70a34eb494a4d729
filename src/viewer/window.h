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
  double x = 0, y = 0;  // of the pointer, from the upper left corner, in heights of the window
  double scroll = 0;    // notches, positive away from the person
};

class Window {
 public:
  // Opens it and makes its OpenGL current in this thread, which has to be the main one. Throws
  // SetupError when there is no display or no OpenGL.
  Window(const std::string& title, const PictureSize& size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Returns the events since the last call; waits up to `seconds` for the first.
  std::vector<WindowEvent> Wait(double seconds);
  // Ends another thread's Wait() early. May be called in any thread.
  static void Wake();
  void Swap();

  bool closed() const;
  PictureSize pixels() const;  // of what is drawn; more than asked for where they are small
  double scale() const;        // of text
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
