// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/buffers.h"
#include "sim/gl/program.h"

namespace throng::sim {

/// Keeps routes up to date with the crowd: where it jams, distances grow and people walk round.
/// Does nothing for scenes without detours.
class Congestion {
  public:
    Congestion(const gl::ShaderLibrary& library, Buffers& buffers, const authoring::Scene& scene,
               const gpu::Parameters& parameters);
    void run();
    /// How many fields are brought up to date at once.
    std::uint32_t fieldsAtOnce() const { return fields_per_run_; }
    /// Some ground costs more for a time. @param now s, simulation time
    void chargeGround(double now);

    /// Where it stands in its rounds: with the buffers, all that it remembers.
    struct Clock {
        std::uint32_t next_field = 0;
        std::uint32_t runs = 0;
    };
    Clock clock() const { return clock_; }
    void setClock(const Clock& clock) { clock_ = clock; }
    std::vector<std::pair<std::string, gl::Buffer*>> remembered();

  private:
    void listBlocks(const gl::Buffer& changed, bool dense_too);
    void readCellsAsTexels();
    void showOverSeams(const gl::ShaderLibrary& library, const Buffers& buffers,
                       const std::vector<glm::uvec2>& shown);
    void takeLifts(const gl::ShaderLibrary& library, const Buffers& buffers,
                   std::span<const authoring::Detours::Ride> rides);
    void show(gl::ComputeProgram& program, std::uint32_t count);

    std::uint32_t cells_ = 0, blocks_ = 0;  // of one map
    std::uint32_t fields_ = 0;
    std::uint32_t runs_per_round_ = 1;  // once a round, the crowd is looked at and every field is relaxed
    std::uint32_t fields_per_run_ = 0;
    Clock clock_;
    std::vector<authoring::Patches::Costs> costs_;  // for a time
    std::vector<bool> charged_;                     // which of them the ground has
    std::vector<gpu::GroundCell> free_ground_;      // without them
    gl::Buffer ground_, free_distances_, distances_, next_distances_, flows_;
    gl::WordTexture ground_texels_, free_texels_, distance_texels_, flow_texels_;
    gl::Buffer field_maps_, dense_blocks_;
    gl::Buffer changed_before_, changed_now_;  // blocks of each field, the last time round and this time
    gl::Buffer listed_, block_dispatch_, no_blocks_;
    gl::ComputeProgram flow_, list_, relax_, keep_, slope_;
    std::uint32_t shown_count_ = 0;  // cells that show others over a seam
    gl::Buffer shown_cells_;
    gl::ComputeProgram show_distances_, show_slopes_;
    std::uint32_t ride_count_ = 0;  // of lifts
    gl::Buffer ride_cells_, ride_costs_;
    gl::ComputeProgram ride_;
};

}  // namespace throng::sim
