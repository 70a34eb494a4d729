#include "viewer/headless_gl.h"

#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

// A shared library, by its name in Debian. One that gave a context stays loaded, as drivers do not
// survive reloading.
class Library {
 public:
  explicit Library(const char* name) : handle_(::dlopen(name, RTLD_NOW | RTLD_GLOBAL)) {
    if (handle_ == nullptr) throw SetupError(::dlerror());
  }

  // One without a context is unloaded: with two libraries MuJoCo would use the wrong one.
  void Unload() { ::dlclose(handle_); }

  template <typename Function>
  Function* Get(const char* name) const {
    auto* function = reinterpret_cast<Function*>(::dlsym(handle_, name));
    if (function == nullptr) throw SetupError(::dlerror());
    return function;
  }

 private:
  void* handle_;
};

class Egl final : public HeadlessGl {
 public:
  Egl() {
    // Mesa prints drivers that failed to standard error.
    ::setenv("EGL_LOG_LEVEL", "fatal", 0);
    for (EGLDisplay display : Displays()) {
      if (MakeCurrent(display)) return;
    }
    library_.Unload();
    throw SetupError("no driver gives an OpenGL context");
  }
  ~Egl() override {
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    destroy_context_(display_, context_);
    terminate_(display_);
  }

  bool is_software() const override {
    constexpr unsigned kRenderer = 0x1F01;  // GL_RENDERER
    const auto get = library_.Get<decltype(eglGetProcAddress)>("eglGetProcAddress");
    const auto text = reinterpret_cast<const unsigned char* (*)(unsigned)>(get("glGetString"));
    const auto* name = text == nullptr ? nullptr : reinterpret_cast<const char*>(text(kRenderer));
    return IsSoftwareRenderer(name == nullptr ? "" : name);
  }

 private:
  // What may have a context without a display, the likely best first: graphics cards in their own
  // order, of which Mesa's software is the last, then Mesa without any device, then the default.
  std::vector<EGLDisplay> Displays() const {
    const auto get = library_.Get<decltype(eglGetProcAddress)>("eglGetProcAddress");
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(get("eglQueryDevicesEXT"));
    const auto of_platform =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(get("eglGetPlatformDisplayEXT"));
    std::vector<EGLDisplay> displays;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (of_platform != nullptr && query != nullptr &&
        query(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
      for (EGLint i = 0; i < count; ++i) {
        displays.push_back(
            of_platform(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
      }
    }
    if (of_platform != nullptr) {
      displays.push_back(of_platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    displays.push_back(library_.Get<decltype(eglGetDisplay)>("eglGetDisplay")(EGL_DEFAULT_DISPLAY));
    return displays;
  }

  bool MakeCurrent(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY) return false;
    if (initialize_(display, nullptr, nullptr) != EGL_TRUE) return false;
    constexpr std::array<EGLint, 7> kWanted = {
        EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,  //
        EGL_SURFACE_TYPE,    EGL_PBUFFER_BIT, EGL_DEPTH_SIZE, 24, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (bind_api_(EGL_OPENGL_API) == EGL_TRUE &&
        choose_config_(display, kWanted.data(), &config, 1, &count) == EGL_TRUE && count > 0) {
      EGLContext context = create_context_(display, config, EGL_NO_CONTEXT, nullptr);
      if (context != EGL_NO_CONTEXT) {
        if (make_current_(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) {
          display_ = display;
          context_ = context;
          return true;
        }
        destroy_context_(display, context);
      }
    }
    terminate_(display);
    return false;
  }

  Library library_{"libEGL.so.1"};
  decltype(eglInitialize)* initialize_ = library_.Get<decltype(eglInitialize)>("eglInitialize");
  decltype(eglTerminate)* terminate_ = library_.Get<decltype(eglTerminate)>("eglTerminate");
  decltype(eglBindAPI)* bind_api_ = library_.Get<decltype(eglBindAPI)>("eglBindAPI");
  decltype(eglChooseConfig)* choose_config_ =
      library_.Get<decltype(eglChooseConfig)>("eglChooseConfig");
  decltype(eglCreateContext)* create_context_ =
      library_.Get<decltype(eglCreateContext)>("eglCreateContext");
  decltype(eglDestroyContext)* destroy_context_ =
      library_.Get<decltype(eglDestroyContext)>("eglDestroyContext");
  decltype(eglMakeCurrent)* make_current_ =
      library_.Get<decltype(eglMakeCurrent)>("eglMakeCurrent");
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

// The functions are declared here and not in GL/osmesa.h, whose package brings a second OpenGL.
class OsMesa final : public HeadlessGl {
 public:
  OsMesa() {
    constexpr unsigned kRgba = 0x1908;          // OSMESA_RGBA
    constexpr unsigned kUnsignedByte = 0x1401;  // GL_UNSIGNED_BYTE
    context_ = library_.Get<void*(unsigned, int, int, int, void*)>("OSMesaCreateContextExt")(
        kRgba, 24, 8, 0, nullptr);
    if (context_ == nullptr ||
        library_.Get<unsigned char(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")(
            context_, pixel_.data(), kUnsignedByte, 1, 1) == 0) {
      throw SetupError("OSMesa gives no OpenGL context");
    }
  }
  ~OsMesa() override { library_.Get<void(void*)>("OSMesaDestroyContext")(context_); }

  bool is_software() const override { return true; }

 private:
  Library library_{"libOSMesa.so.8"};
  std::array<unsigned char, 4> pixel_{};  // its buffer, which is not used
  void* context_ = nullptr;
};

}  // namespace

bool IsSoftwareRenderer(std::string_view name) {
  return name.starts_with("llvmpipe") || name.starts_with("softpipe");
}

std::unique_ptr<HeadlessGl> MakeHeadlessGl(const std::string& which) {
  std::string why;
  const auto attempt = [&](const char* name, auto make) -> std::unique_ptr<HeadlessGl> {
    if (!which.empty() && which != name) return nullptr;
    try {
      return make();
    } catch (const SetupError& error) {
      why += (why.empty() ? "" : "; ") + std::string(name) + ": " + error.what();
      return nullptr;
    }
  };
  if (auto gl = attempt("egl", [] { return std::make_unique<Egl>(); })) return gl;
  if (auto gl = attempt("osmesa", [] { return std::make_unique<OsMesa>(); })) return gl;
  throw SetupError("no OpenGL to draw with (" + why +
                   "): apt-get install libegl1 libgl1-mesa-dri, or libosmesa6");
}

}  // namespace understudy::viewer
