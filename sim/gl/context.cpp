// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace throng::gl {
namespace {

constexpr const char* kInstallHint =
    "On Debian, install the Mesa drivers: apt-get install libegl1 libopengl0 libgl1-mesa-dri (or the "
    "GPU vendor's driver with EGL).";

bool hasExtension(const char* extensions, const char* name) {
    if (!extensions) return false;
    const std::size_t length = std::strlen(name);
    for (const char* at = extensions; (at = std::strstr(at, name)); at += length) {
        const bool starts = at == extensions || at[-1] == ' ';
        const bool ends = at[length] == '\0' || at[length] == ' ';
        if (starts && ends) return true;
    }
    return false;
}

/// A display that may or may not be able to give us a context.
struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string platform;
    bool software = false;
    std::string problem;
};

bool hasOpenGl() {
    // Stays open: libepoxy is going to open it as well.
    return dlopen("libOpenGL.so.0", RTLD_LAZY) || dlopen("libGL.so.1", RTLD_LAZY);
}

const char* clientExtensions() {
    // libepoxy aborts the process where a library is absent, so look for them first.
    if (!epoxy_has_egl())
        throw GraphicsError(fmt::format("there is no EGL library (libEGL.so.1) here. {}", kInstallHint));
    if (!hasOpenGl())
        throw GraphicsError(
            fmt::format("there is no OpenGL library (libOpenGL.so.0) here. {}", kInstallHint));
    return eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
}

std::vector<Candidate> candidatesFromDevices(const char* extensions) {
    std::vector<Candidate> candidates;
    if (!hasExtension(extensions, "EGL_EXT_platform_device")) return candidates;
    if (!hasExtension(extensions, "EGL_EXT_device_base") &&
        !hasExtension(extensions, "EGL_EXT_device_enumeration"))
        return candidates;
    EGLint count = 0;
    if (!eglQueryDevicesEXT(0, nullptr, &count) || count == 0) return candidates;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    eglQueryDevicesEXT(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices) {
        Candidate candidate;
        candidate.platform = "device";
        candidate.software =
            hasExtension(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        candidate.display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        candidates.push_back(candidate);
    }
    return candidates;
}

std::vector<Candidate> allCandidates() {
    const char* extensions = clientExtensions();
    std::vector<Candidate> candidates = candidatesFromDevices(extensions);
    if (candidates.empty() && hasExtension(extensions, "EGL_MESA_platform_surfaceless")) {
        Candidate candidate;
        candidate.platform = "surfaceless";
        candidate.display =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        candidates.push_back(candidate);
    }
    // Real devices first; EGL's own order is arbitrary but stable.
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.software < b.software; });
    return candidates;
}

/// @param robust one that tells of resets, and stays inside its buffers
EGLContext createContext(EGLDisplay display, bool debug, bool robust) {
    std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                      EGL_CONTEXT_MINOR_VERSION,       5,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    if (debug) attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
    if (robust)
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                           EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

/// @returns EGL_NO_CONTEXT and a filled-in problem when this display cannot do what we need.
EGLContext makeContext(Candidate& candidate, bool debug) {
    if (candidate.display == EGL_NO_DISPLAY || !eglInitialize(candidate.display, nullptr, nullptr)) {
        candidate.problem =
            "EGL cannot open this device (no driver for it, or no permission for its device file)";
        return EGL_NO_CONTEXT;
    }
    const char* extensions = eglQueryString(candidate.display, EGL_EXTENSIONS);
    if (!hasExtension(extensions, "EGL_KHR_no_config_context") ||
        !hasExtension(extensions, "EGL_KHR_surfaceless_context")) {
        candidate.problem = "its EGL lacks contexts without a surface";
        return EGL_NO_CONTEXT;
    }
    eglBindAPI(EGL_OPENGL_API);
    EGLContext context = EGL_NO_CONTEXT;
    if (hasExtension(extensions, "EGL_EXT_create_context_robustness"))
        context = createContext(candidate.display, debug, true);
    // Some drivers offer the extension and then make no such context.
    if (context == EGL_NO_CONTEXT) context = createContext(candidate.display, debug, false);
    if (context == EGL_NO_CONTEXT) {
        candidate.problem = "it does not offer OpenGL 4.5 core";
        return EGL_NO_CONTEXT;
    }
    if (!eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        candidate.problem = "its context cannot be made current without a surface";
        eglDestroyContext(candidate.display, context);
        return EGL_NO_CONTEXT;
    }
    return context;
}

std::string glString(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

Device describe(const Candidate& candidate, int index, bool current) {
    Device device;
    device.index = index;
    device.platform = candidate.platform;
    device.software = candidate.software;
    device.usable = current;
    device.problem = candidate.problem;
    if (current) {
        device.name = glString(GL_RENDERER);
        device.vendor = glString(GL_VENDOR);
        device.version = glString(GL_VERSION);
        device.software = device.software || device.name.find("llvmpipe") != std::string::npos ||
                          device.name.find("softpipe") != std::string::npos;
    }
    return device;
}

void destroyContext(EGLDisplay display, EGLContext context) {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
}

}  // namespace

std::vector<Device> listDevices() {
    std::vector<Device> devices;
    for (Candidate& candidate : allCandidates()) {
        EGLContext context = makeContext(candidate, false);
        const bool usable = context != EGL_NO_CONTEXT;
        devices.push_back(describe(candidate, static_cast<int>(devices.size()), usable));
        if (usable) destroyContext(candidate.display, context);
    }
    return devices;
}

bool hasRealDevice() {
    const std::vector<Candidate> candidates = candidatesFromDevices(clientExtensions());
    return std::any_of(candidates.begin(), candidates.end(),
                       [](const Candidate& candidate) { return !candidate.software; });
}

namespace {
thread_local bool current_is_software = false;
}  // namespace

bool Context::currentIsSoftware() {
    return current_is_software;
}

struct Context::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    Device device;
    std::vector<std::string> messages;

    static void GLAPIENTRY onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei,
                                     const GLchar* text, const void* user) {
        // Performance notes and group markers are talk; the rest would be somebody's bug.
        if (type == GL_DEBUG_TYPE_PERFORMANCE || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
        if (type == GL_DEBUG_TYPE_OTHER && severity == GL_DEBUG_SEVERITY_LOW) return;
        static_cast<State*>(const_cast<void*>(user))->messages.emplace_back(text);
    }
};

Context::Context(const Options& options) : state_(std::make_unique<State>()) {
    std::vector<Candidate> candidates = allCandidates();
    if (candidates.empty())
        throw GraphicsError(fmt::format("EGL offers no device to draw with. {}", kInstallHint));
    if (options.device >= static_cast<int>(candidates.size()))
        throw GraphicsError(fmt::format("there is no device {}: `throng devices` lists {} (0 to {})",
                                        options.device, candidates.size(), candidates.size() - 1));
    std::string problems;
    for (int index = 0; index < static_cast<int>(candidates.size()); ++index) {
        if (options.device >= 0 && index != options.device) continue;
        Candidate& candidate = candidates[static_cast<std::size_t>(index)];
        EGLContext context = makeContext(candidate, options.debug);
        if (context == EGL_NO_CONTEXT) {
            problems += fmt::format("\n  device {}: {}", index, candidate.problem);
            continue;
        }
        state_->display = candidate.display;
        state_->context = context;
        state_->device = describe(candidate, index, true);
        current_is_software = state_->device.software;
        break;
    }
    if (state_->context == EGL_NO_CONTEXT)
        throw GraphicsError(fmt::format("no usable OpenGL 4.5 device:{}\n{}", problems, kInstallHint));
    if (options.debug) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(&State::onMessage, state_.get());
    }
}

Context::~Context() {
    if (state_ && state_->context != EGL_NO_CONTEXT) destroyContext(state_->display, state_->context);
}

const Device& Context::device() const {
    return state_->device;
}

const std::vector<std::string>& Context::debugMessages() const {
    return state_->messages;
}

void Context::check(const char* where) const {
    if (const GLenum reset = glGetGraphicsResetStatus(); reset != GL_NO_ERROR)
        throw DeviceLost(
            fmt::format("{}: the GPU was reset and the work on it is lost (status {:#x})", where, reset));
    if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
        const char* name = error == GL_OUT_OF_MEMORY ? "the device is out of memory" : "OpenGL error";
        throw GraphicsError(fmt::format("{}: {} ({:#x})", where, name, error));
    }
}

}  // namespace throng::gl
