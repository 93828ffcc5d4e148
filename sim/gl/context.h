// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace throng::gl {

/// No usable OpenGL: no device, no driver, too old a version, a lost device. The message says what to do.
struct GraphicsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The device was reset or taken away while it worked: what is on it is lost, and a new process may have more
/// luck.
struct DeviceLost : GraphicsError {
    using GraphicsError::GraphicsError;
};

/// A device that EGL offers. Devices are told apart by what they say of themselves; EGL's order means
/// nothing.
struct Device {
    int index = 0;          ///< what `--device` takes; counted after sorting, real devices first
    std::string name;       ///< GL_RENDERER
    std::string vendor;     ///< GL_VENDOR
    std::string version;    ///< GL_VERSION, the driver's name and number in it
    std::string platform;   ///< "device" or "surfaceless"
    bool software = false;  ///< a CPU renderer (EGL_MESA_device_software)
    bool usable = false;    ///< an OpenGL 4.5 core context could be made
    std::string problem;    ///< why not
};

/// All devices, usable or not.
/// @throws GraphicsError where there is no EGL at all, naming the Debian packages to install.
std::vector<Device> listDevices();

/// Whether EGL knows of a device that is no software renderer. Makes no context.
bool hasRealDevice();

/// A headless OpenGL 4.5 core context, current on the thread that made it until destroyed.
class Context {
  public:
    struct Options {
        int device =
            -1;  ///< index from listDevices(), -1 = the first usable one, real devices before software
        bool debug = false;  ///< KHR_debug output, synchronous
    };

    /// @throws GraphicsError
    explicit Context(const Options& options);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Device& device() const;
    /// Whether what is current on this thread is a CPU renderer.
    static bool currentIsSoftware();

    /// Messages of KHR_debug (errors, undefined behaviour, portability) since the context was made. Needs
    /// Options::debug.
    const std::vector<std::string>& debugMessages() const;

    /// @throws DeviceLost when the driver reports that, GraphicsError when any GL error is pending; `where`
    /// goes in the message.
    void check(const char* where) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace throng::gl
