// Creates an OpenGL ES context without a window.
#include "observe/egl/headless_context.h"

#include <optional>
#include <vector>

#include "core/format.h"

namespace barehand {
namespace {

tl::unexpected<Error> egl_failure(const Egl& egl, const std::string& what) {
  return fail(formatted("%s (EGL error 0x%04x)", what.c_str(), egl.GetError()), "EGL");
}

/// Creates a context that reports when it is lost, if the driver supports this.
EGLContext create_context(const Egl& egl, EGLDisplay display) {
  std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1};
  if (has_extension(egl.QueryString(display, EGL_EXTENSIONS), "EGL_EXT_create_context_robustness"))
    attributes.insert(attributes.end(),
                      {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT, EGL_LOSE_CONTEXT_ON_RESET_EXT});
  attributes.push_back(EGL_NONE);
  return egl.CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::open(const Egl& egl, DeviceChoice choice) {
  const bool with_software = choice == DeviceChoice::any;
  std::optional<Error> reason;
  for (EGLDisplay display : find_displays(egl, with_software)) {
    auto context = open_on(egl, display);
    if (context && (with_software || !(*context)->device().software)) return context;
    if (!context && !reason) reason = context.error();
  }
  egl.ReleaseThread();
  if (reason) return tl::unexpected(*reason);
  return fail(with_software ? "no graphics device" : "no hardware graphics device", "EGL",
              "install the GPU's driver; its user needs access to /dev/dri (group render)");
}

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::open_on(const Egl& egl, EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY) return fail("no display", "EGL");
  if (!egl.Initialize(display, &major, &minor)) return egl_failure(egl, "the graphics device cannot be opened");
  if (!egl.BindAPI(EGL_OPENGL_ES_API)) return egl_failure(egl, "no OpenGL ES");
  EGLContext handle = create_context(egl, display);
  if (handle == EGL_NO_CONTEXT) return egl_failure(egl, "no OpenGL ES 3.1 context without a window");
  std::unique_ptr<HeadlessContext> context(new HeadlessContext(egl, display, handle));
  const auto current = context->make_current();
  if (!current) return tl::unexpected(current.error());
  return context;
}

Result<void> HeadlessContext::make_current() {
  if (!egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    return egl_failure(egl_, "the context cannot be used");
  auto gl = load_gl(egl_);
  if (!gl) return tl::unexpected(gl.error());
  gl_ = *gl;
  const auto text = [&](GLenum name) {
    const auto* string = reinterpret_cast<const char*>(gl_.GetString(name));
    return std::string(string ? string : "");
  };
  device_ = {text(GL_RENDERER), text(GL_VERSION), is_software_renderer(text(GL_RENDERER))};
  return {};
}

HeadlessContext::~HeadlessContext() {
  egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  egl_.DestroyContext(display_, context_);
  egl_.ReleaseThread();
}

}  // namespace barehand
