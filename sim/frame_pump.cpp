// SPDX-License-Identifier: Apache-2.0
#include "sim/frame_pump.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/door_track.h"
#include "base/lift_track.h"
#include "base/vehicle_track.h"
#include "sim/gl/context.h"
#include "sim/simulation_parts.h"

namespace throng::sim {
namespace {

struct Slot {
    gl::Buffer frame;
    gl::Buffer owners;
    gl::Buffer distances;
    gl::Buffer seconds;
    PerStream<gl::Buffer> streams;
    gl::Buffer vehicles, vehicle_boxes;  // none without vehicles
    gl::Buffer lifts;                    // likewise
    gl::Buffer services;                 // of vehicles; none without platforms
    GLsync fence = nullptr;
    std::uint32_t index = 0;
    bool has_diagram = false;
    bool busy = false;  // between submit() and the receiver's return
};

template <class T>
std::span<const T> view(const gl::Buffer& buffer, std::size_t first, std::size_t count) {
    return {reinterpret_cast<const T*>(buffer.mapped()) + first, count};
}

/// Places in the scene frame; the ground's height is known to those who write them.
void trackVehicles(std::span<const gpu::Vehicle> vehicles, std::span<const gpu::VehicleBox> boxes,
                   std::vector<float>& track) {
    track.clear();
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
        const gpu::Vehicle& vehicle = vehicles[i];
        const gpu::VehicleBox& box = boxes[i];
        if (box.half_width <= 0.0f) {
            track.insert(track.end(), kVehicleFloats, 0.0f);
            continue;
        }
        const glm::vec2 middle = 0.5f * (box.rear + box.front), way = box.front - box.rear;
        const float state = vehicle.status == gpu::VEHICLE_STANDS ? kVehicleStands : kVehicleDrives;
        for (const float value : {middle.x, middle.y, 0.0f, std::atan2(way.y, way.x), vehicle.speed,
                                  vehicle.along, state, std::max(-vehicle.acceleration, 0.0f)})
            track.push_back(value);
    }
}

void trackDoors(std::span<const gpu::VehicleService> services, std::span<const float> sides,
                std::vector<float>& track) {
    track.clear();
    for (const gpu::VehicleService& service : services) {
        const bool stands = service.platform != gpu::NO_INDEX;
        const bool on_left = stands && sides[service.platform] > 0.0f;
        track.insert(track.end(), {on_left ? service.open : 0.0f, stands && !on_left ? service.open : 0.0f,
                                   static_cast<float>(service.aboard), static_cast<float>(service.boarded),
                                   static_cast<float>(service.alighted)});
    }
}

}  // namespace

struct FramePump::State {
    Simulation& simulation;
    Receiver receiver;
    Cargo cargo;
    std::vector<Slot> slots;
    std::size_t next = 0;
    std::size_t rows = 0;
    DiagramImage image;  // all but the pixels
    std::vector<float> metres;
    std::vector<std::uint32_t> sites, seconds;  // with charts
    std::vector<float> vehicles;                // kVehicleFloats each
    std::vector<float> lifts;                   // kLiftFloats each
    std::vector<float> doors;                   // kDoorFloats each

    std::deque<Slot*> in_flight;  // GL thread only: submitted, fence not yet seen

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Slot*> ready;
    std::exception_ptr failure;
    bool closing = false;
    std::thread thread;

    State(Simulation& the_simulation, const Cargo& the_cargo, Receiver the_receiver)
        : simulation(the_simulation),
          receiver(std::move(the_receiver)),
          cargo(the_cargo),
          slots(framesUnderWay(the_simulation.parameters().row_count)) {}

    bool asksForDiagram() const;
    void packStreams(Slot& slot, bool of_diagram);
    void receiveAll();
    void deliver(const Slot& slot);
    std::span<const std::uint32_t> ofPeople(std::span<const std::uint32_t> ids,
                                            std::vector<std::uint32_t>& kept) const;
    void handOver(bool wait);
    void rethrow();
};

namespace {

void checkImageSize(const gpu::Parameters& parameters) {
    constexpr double kMostPixels = 33'554'432.0;
    const double pixels = static_cast<double>(parameters.diagram_width) * parameters.diagram_height;
    if (pixels > kMostPixels)
        throw gl::GraphicsError(
            fmt::format("diagram images of {} x {} pixels are too large (at most {:.0f} million in all). Set "
                        "simulation.pixels_per_metre to at most {:.2f}, or bake without --diagrams.",
                        parameters.diagram_width, parameters.diagram_height, kMostPixels / 1e6,
                        static_cast<double>(parameters.pixels_per_metre) * std::sqrt(kMostPixels / pixels)));
}

}  // namespace

FramePump::FramePump(Simulation& simulation, const Cargo& cargo, Receiver receiver)
    : state_(std::make_unique<State>(simulation, cargo, std::move(receiver))) {
    if (cargo.diagrams) checkImageSize(simulation.parameters());
    const gpu::Parameters& parameters = simulation.parameters();
    state_->rows = parameters.row_count;
    const std::size_t pixels = std::size_t{parameters.diagram_width} * parameters.diagram_height;
    state_->image.width = parameters.diagram_width;
    state_->image.height = parameters.diagram_height;
    state_->image.minimum = parameters.diagram_minimum;
    state_->image.pixels_per_metre = parameters.pixels_per_metre;
    state_->image.agent_count = parameters.row_count;
    if (simulation.vehicles() > 0)
        state_->image.wall_count = simulation.diagram().firstVehicle() - parameters.site_rows;
    for (Slot& slot : state_->slots) {
        slot.frame = gl::Buffer("frame read-back", simulation.frameBytes(), gl::Buffer::Use::read_back);
        for (const StreamInfo& info : kStreams)
            if (cargo.streams[info.id])
                slot.streams[info.id] =
                    gl::Buffer(fmt::format("{} read-back", info.name),
                               state_->rows * kComponents * sizeof(float), gl::Buffer::Use::read_back);
        if (simulation.vehicles() > 0) {
            const Buffers& buffers = simulation.parts().buffers;
            slot.vehicles =
                gl::Buffer("vehicles read-back", buffers.vehicles.bytes(), gl::Buffer::Use::read_back);
            slot.vehicle_boxes = gl::Buffer("vehicle boxes read-back", buffers.vehicle_boxes.bytes(),
                                            gl::Buffer::Use::read_back);
        }
        if (simulation.hasDoors())
            slot.services =
                gl::Buffer("services read-back", simulation.parts().buffers.vehicle_services.bytes(),
                           gl::Buffer::Use::read_back);
        if (simulation.lifts() > 0)
            slot.lifts = gl::Buffer("lifts read-back", simulation.parts().buffers.lift_states.bytes(),
                                    gl::Buffer::Use::read_back);
        if (!cargo.diagrams) continue;
        if (cargo.seconds)
            slot.seconds = gl::Buffer("second owners read-back", pixels * 4, gl::Buffer::Use::read_back);
        slot.owners = gl::Buffer("diagram owners read-back", pixels * 4, gl::Buffer::Use::read_back);
        slot.distances = gl::Buffer("diagram distances read-back", pixels * 4, gl::Buffer::Use::read_back);
    }
    state_->thread = std::thread([state = state_.get()] { state->receiveAll(); });
    ::pthread_setname_np(state_->thread.native_handle(),
                         "throng-frames");  // for those who watch what takes time
}

FramePump::~FramePump() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->closing = true;
    }
    state_->changed.notify_all();
    state_->thread.join();
    for (Slot& slot : state_->slots)
        if (slot.fence) glDeleteSync(slot.fence);
}

bool FramePump::submit(std::uint32_t index, bool with_diagram) {
    State& state = *state_;
    Slot& slot = state.slots[state.next];
    state.next = (state.next + 1) % state.slots.size();
    while (!state.in_flight.empty() && state.in_flight.front() == &slot)
        state.handOver(true);
    {
        std::unique_lock lock(state.mutex);
        state.changed.wait(lock, [&] { return !slot.busy || state.failure; });
    }
    state.rethrow();

    slot.index = index;
    slot.has_diagram = with_diagram;
    state.simulation.packFrame(slot.frame);
    state.packStreams(slot, false);
    if (state.simulation.vehicles() > 0) {
        slot.vehicles.copyFrom(state.simulation.parts().buffers.vehicles);
        slot.vehicle_boxes.copyFrom(state.simulation.parts().buffers.vehicle_boxes);
    }
    if (state.simulation.hasDoors())
        slot.services.copyFrom(state.simulation.parts().buffers.vehicle_services);
    if (state.simulation.lifts() > 0) slot.lifts.copyFrom(state.simulation.parts().buffers.lift_states);
    const Extent extent = with_diagram ? Extent::everywhere : Extent::near_people;
    if ((with_diagram || state.asksForDiagram()) && !state.simulation.buildDiagramNow(extent)) {
        state.next = (state.next + state.slots.size() - 1) % state.slots.size();
        return false;
    }
    state.packStreams(slot, true);
    if (with_diagram) {
        Diagram& diagram = state.simulation.diagram();
        slot.owners.copyFrom(diagram.wholeOwners());
        slot.distances.copyFrom(diagram.measureDistances());
        if (state.cargo.seconds) slot.seconds.copyFrom(diagram.findSeconds());
    }
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    slot.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    {
        const std::lock_guard lock(state.mutex);
        slot.busy = true;
    }
    state.in_flight.push_back(&slot);
    state.handOver(false);
    return true;
}

void FramePump::finish() {
    State& state = *state_;
    while (!state.in_flight.empty())
        state.handOver(true);
    {
        std::unique_lock lock(state.mutex);
        state.changed.wait(lock, [&] {
            for (const Slot& slot : state.slots)
                if (slot.busy) return state.failure != nullptr;
            return true;
        });
    }
    state.rethrow();
}

bool FramePump::State::asksForDiagram() const {
    return std::ranges::any_of(
        kStreams, [&](const StreamInfo& info) { return cargo.streams[info.id] && info.needs_diagram; });
}

void FramePump::State::packStreams(Slot& slot, bool of_diagram) {
    for (const StreamInfo& info : kStreams)
        if (cargo.streams[info.id] && info.needs_diagram == of_diagram)
            simulation.packStream(info.id, slot.streams[info.id]);
}

/// Gives the receiver those frames whose fences have been passed, in order.
void FramePump::State::handOver(bool wait) {
    while (!in_flight.empty()) {
        Slot* slot = in_flight.front();
        const GLuint64 patience = wait ? 1'000'000'000 : 0;
        const GLenum status = glClientWaitSync(slot->fence, GL_SYNC_FLUSH_COMMANDS_BIT, patience);
        if (status == GL_WAIT_FAILED || glGetGraphicsResetStatus() != GL_NO_ERROR)
            throw gl::DeviceLost("the GPU was reset while a frame was under way, and the work on it is lost");
        if (status == GL_TIMEOUT_EXPIRED) {
            if (wait) continue;
            return;
        }
        glDeleteSync(slot->fence);
        slot->fence = nullptr;
        in_flight.pop_front();
        {
            const std::lock_guard lock(mutex);
            ready.push_back(slot);
        }
        changed.notify_all();
        wait = false;
    }
}

void FramePump::State::rethrow() {
    const std::lock_guard lock(mutex);
    if (failure) std::rethrow_exception(failure);
}

void FramePump::State::receiveAll() {
    for (;;) {
        Slot* slot = nullptr;
        {
            std::unique_lock lock(mutex);
            changed.wait(lock, [&] { return !ready.empty() || closing; });
            if (closing) return;
            slot = ready.front();
            ready.pop_front();
        }
        try {
            deliver(*slot);
        } catch (...) {
            const std::lock_guard lock(mutex);
            failure = std::current_exception();
            changed.notify_all();
            return;
        }
        {
            const std::lock_guard lock(mutex);
            slot->busy = false;
        }
        changed.notify_all();
    }
}

/// Images of people beside seams own pixels as these people do.
std::span<const std::uint32_t> FramePump::State::ofPeople(std::span<const std::uint32_t> ids,
                                                          std::vector<std::uint32_t>& kept) const {
    const auto people = static_cast<std::uint32_t>(rows);
    const std::uint32_t all = simulation.parameters().site_rows;
    if (all == people) return ids;
    kept.assign(ids.begin(), ids.end());
    for (std::uint32_t& id : kept)
        if (id != gpu::NO_INDEX) id = id < all ? id % people : id - all + people;
    return kept;
}

void FramePump::State::deliver(const Slot& slot) {
    Frame frame;
    frame.index = slot.index;
    const std::size_t floats = rows * kComponents;
    frame[Stream::pos] = view<float>(slot.frame, 0, floats);
    frame[Stream::dir] = view<float>(slot.frame, floats, floats);
    frame[Stream::state] = view<float>(slot.frame, 2 * floats, floats);
    for (const StreamInfo& info : kStreams)
        if (cargo.streams[info.id]) frame[info.id] = view<float>(slot.streams[info.id], 0, floats);
    if (simulation.vehicles() > 0) {
        trackVehicles(view<gpu::Vehicle>(slot.vehicles, 0, simulation.vehicles()),
                      view<gpu::VehicleBox>(slot.vehicle_boxes, 0, simulation.vehicles()), vehicles);
        frame.vehicles = vehicles;
    }
    if (simulation.hasDoors()) {
        trackDoors(view<gpu::VehicleService>(slot.services, 0, simulation.vehicles()),
                   simulation.parts().platform_sides, doors);
        frame.doors = doors;
    }
    if (simulation.lifts() > 0) {
        lifts.clear();
        for (const gpu::LiftState& lift : view<gpu::LiftState>(slot.lifts, 0, simulation.lifts()))
            lifts.insert(lifts.end(), {lift.height, lift.open, static_cast<float>(lift.aboard),
                                       static_cast<float>(lift.stop)});
        frame.lifts = lifts;
    }
    DiagramImage diagram = image;
    if (slot.has_diagram) {
        const std::size_t pixels = std::size_t{image.width} * image.height;
        diagram.site = ofPeople(view<std::uint32_t>(slot.owners, 0, pixels), sites);
        const std::span<const float> squared = view<float>(slot.distances, 0, pixels);
        metres.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            metres[i] = std::sqrt(squared[i]) / image.pixels_per_metre;
        diagram.distance = metres;
        if (cargo.seconds) diagram.second = ofPeople(view<std::uint32_t>(slot.seconds, 0, pixels), seconds);
        frame.diagram = &diagram;
    }
    receiver(frame);
}

}  // namespace throng::sim
