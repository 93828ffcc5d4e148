// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/device_fields.h"

#include "sim/field_solver.h"
#include "sim/gl/context.h"

namespace throng::cli {
namespace {

/// Every field takes the same programs.
gl::ShaderLibrary keptPrograms(const std::string& shader_dir) {
    gl::ShaderLibrary library(shader_dir);
    library.keepPrograms();
    return library;
}

class DeviceFields : public authoring::DistanceSolver {
  public:
    DeviceFields(int device, const std::string& shader_dir)
        : context_({device, false}), solver_(keptPrograms(shader_dir)) {}

    const gl::Device& device() const { return context_.device(); }

    std::vector<float> solve(const authoring::WalkMap& map, const std::vector<float>& start) override {
        std::vector<float> distances = solver_.solve(map, start);
        context_.check("solving distance fields");
        return distances;
    }

  private:
    gl::Context context_;
    sim::FieldSolver solver_;
};

}  // namespace

std::unique_ptr<authoring::DistanceSolver> makeDeviceFields(FieldsBy by, int device,
                                                            const std::string& shader_dir) {
    if (by == FieldsBy::cpu) return nullptr;
    // Asked first: Mesa's renderer takes its settings from the environment when its first context is made.
    if (by == FieldsBy::automatic && !gl::hasRealDevice()) return nullptr;
    auto fields = std::make_unique<DeviceFields>(device, shader_dir);
    if (by == FieldsBy::automatic && fields->device().software) return nullptr;
    return fields;
}

}  // namespace throng::cli
