// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/baker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>

#include "base/build_name.h"
#include "base/files/hash.h"
#include "base/stopwatch.h"
#include "cli/baking/calibration_file.h"
#include "cli/baking/frame_maker.h"
#include "io/bake_reader.h"
#include "io/checkpoint.h"
#include "io/verify_bake.h"

namespace throng::cli {
namespace {

constexpr const char* kSeconds = "seconds";
constexpr const char* kMotion = "motion";
constexpr const char* kWhoWasThere = "who was there";
constexpr const char* kVehicleTrack = "vehicle track";
constexpr const char* kLiftTrack = "lift track";
constexpr const char* kDoorTrack = "door track";

/// Everything that the bytes of a bake depend on.
std::string identityOf(const LoadedLayout& loaded, const BakeJob& job, const gl::Device& device) {
    std::string text =
        fmt::format("{} {}\n{}\n{}\n{} {} {} {} {}\n", THRONG_VERSION, buildName(), device.name,
                    device.version, job.diagram_every, job.seconds, throng::identityOf(job.streams),
                    job.options.gltf, job.options.gltf_agents);
    for (const std::string& override_text : loaded.overrides)
        text += override_text + "\n";
    if (job.options.formats != StreamFormats::standard())
        text += fmt::format("streams as {}\n", wordsOf(job.options.formats));
    if (loaded.fields_on_device) text += "fields on the device\n";  // other bits than the CPU's
    if (loaded.terrain) text += fmt::format("{:016x}\n", loaded.terrain_identity);
    if (loaded.given_identity != 0) text += fmt::format("{:016x}\n", loaded.given_identity);
    return hashText(text + loaded.text);
}

/// The bake of an earlier run that has come to its end, so that there is nothing left to go on with.
/// @throws InputError where it has been damaged since, unless it is to be replaced then
std::optional<io::Bake> findComplete(const recording::BakeDescription& description,
                                     const std::string& identity) {
    const std::filesystem::path bake(description.output);
    if (!std::filesystem::exists(bake / "bake.json")) return std::nullopt;
    std::optional<io::Bake> found;
    try {
        found = io::loadBake(bake);
    } catch (const InputError&) {
        return std::nullopt;
    }
    if (!found->complete || found->manifest.value("inputs", "") != "xxh3:" + identity) return std::nullopt;
    io::BakeWriter::tidy(bake);
    const io::Verification verification = io::verifyBake(bake);
    if (verification.problems.empty()) return found;
    if (description.force) return std::nullopt;
    const io::BakeProblem& first = verification.problems.front();
    throw InputError(
        bake, fmt::format("is complete, but not as it was written ({}: {}); `throng verify` tells all, "
                          "--force bakes it anew",
                          first.path, first.message));
}

/// From where an earlier run is to be gone on with, if it is.
std::optional<io::Checkpoint> findCheckpoint(const recording::BakeDescription& description,
                                             const BakeJob& job, const std::string& identity) {
    if (job.checkpoint_seconds <= 0.0 && !job.resume) return std::nullopt;
    const std::filesystem::path folder = io::BakeFolder::unfinishedPath(description.output);
    std::optional<io::Checkpoint> checkpoint = io::loadCheckpoint(folder);
    if (job.resume && !job.options.force && io::hasOnlyTornCheckpoints(folder))
        throw InputError(folder,
                         "its checkpoints are damaged: their checksums do not fit, so nothing goes on from "
                         "there; --force starts over");
    if (!checkpoint) return std::nullopt;
    if (job.resume && checkpoint->identity == identity) return checkpoint;
    if (job.options.force) return std::nullopt;
    if (job.resume)
        throw OutputError(folder,
                          "was begun with another layout, other options, another driver or another build of "
                          "throng; --force starts over");
    throw OutputError(folder, fmt::format("holds the first {} of {} frames of an earlier run; --resume "
                                          "goes on with it, --force starts over",
                                          checkpoint->frames, description.frames));
}

/// @param checkpoint goes where the files beside it do not fit it and everything may be begun anew
std::unique_ptr<io::BakeWriter> makeWriter(const recording::BakeDescription& description, const BakeJob& job,
                                           std::optional<io::Checkpoint>& checkpoint) {
    if (checkpoint) try {
            return std::make_unique<io::BakeWriter>(description, &*checkpoint);
        } catch (const InputError&) {
            if (!job.options.force) throw;
            checkpoint.reset();
        }
    if (job.checkpoint_seconds > 0.0) return std::make_unique<io::BakeWriter>(description, nullptr);
    return std::make_unique<io::BakeWriter>(description);
}

/// With those who have had their seats all along.
Account withAudience(Account account, std::size_t seated) {
    account.spawned += static_cast<std::uint32_t>(seated);
    account.arrived += static_cast<std::uint32_t>(seated);
    AgentOutcome outcome;
    outcome.status = AgentStatus::arrived;
    outcome.spawn_frame = outcome.arrival_frame = 0;
    account.agents.resize(account.agents.size() + seated, outcome);
    return account;
}

/// One bake under way.
class Run {
  public:
    Run(const gl::Context& context, sim::Simulation& simulation,
        const authoring::SimulationSettings& settings, const BakeJob& job, io::BakeWriter& writer,
        const recording::BakeDescription& description, std::string identity)
        : context_(context),
          simulation_(simulation),
          job_(job),
          writer_(writer),
          identity_(std::move(identity)),
          frames_(description.frames),
          maker_(
              simulation, settings, description, {job.diagram_every, job.seconds},
              [this](const Frame& frame) { receive(frame); },
              [&writer](const Frame& frame) { writer.write(frame); }) {
        if (settings.ends_when_empty) maker_.endWhenEmpty(settings.fps);
    }

    void goOnFrom(const io::Checkpoint& checkpoint) {
        simulation_.restore({checkpoint.steps, checkpoint.sections});
        const std::vector<std::byte>* motion = checkpoint.find(kMotion);
        if (!motion) throw std::runtime_error("the checkpoint says nothing of the motion so far");
        maker_.recorder().restore(*motion);
        if (EmptyWatch* empty = maker_.emptyWatch()) {
            const std::vector<std::byte>* seen = checkpoint.find(kWhoWasThere);
            if (!seen) throw std::runtime_error("the checkpoint does not say who has been there");
            empty->restore(*seen);
        }
        takeTrack(checkpoint, kVehicleTrack, vehicles_);
        takeTrack(checkpoint, kLiftTrack, lifts_);
        takeTrack(checkpoint, kDoorTrack, doors_);
        writer_.showVehicles(vehicles_);
        if (const std::vector<std::byte>* bytes = checkpoint.find(kSeconds);
            bytes && bytes->size() == sizeof seconds_before_)
            std::memcpy(&seconds_before_, bytes->data(), sizeof seconds_before_);
    }

    /// @returns the signal that stopped it early, or 0
    int simulate(const InterruptGuard& interrupt, Progress& progress) {
        start_ = last_checkpoint_ = Clock::now();
        simulation_.stopWhen([&] { return interrupt.signal() != 0; });
        const auto warming = [&] {
            progress.update(0, 0, simulation_.stepsDone());
            return interrupt.signal() == 0;
        };
        if (!interrupt.signal()) maker_.warmUp(warming);
        const auto goes_on = [&] { return !interrupt.signal() && !maker_.hasEnded(); };
        for (std::uint32_t frame = maker_.frames(); frame < frames_ && goes_on(); ++frame) {
            if (!makeFrame(frame)) break;
            progress.update(frame + 1, maker_.present(), simulation_.stepsDone());
            if (job_.checkpoint_seconds > 0.0 && frame + 1 < frames_ &&
                secondsSince(last_checkpoint_) >= job_.checkpoint_seconds)
                save();
        }
        maker_.wait();
        const std::uint32_t taken = maker_.frames();
        progress.update(taken, maker_.present(), maker_.warmUpSteps() + taken * maker_.substeps());
        return taken < frames_ && !maker_.hasEnded() ? interrupt.signal() : 0;
    }

    /// Writes the frames that wait for later ones.
    void finish() {
        maker_.finish();
        writer_.takeVehicles(std::move(vehicles_));
        writer_.takeLifts(std::move(lifts_));
        writer_.takeDoors(std::move(doors_));
    }
    std::uint32_t frames() const { return maker_.frames(); }
    /// Where nobody is left, some may have been made for frames that the bake does not have.
    std::uint32_t steps() const {
        return maker_.hasEnded() ? maker_.warmUpSteps() + (frames() - 1) * maker_.substeps()
                                 : simulation_.stepsDone();
    }

    void save() {
        maker_.wait();
        io::Checkpoint checkpoint;
        checkpoint.identity = identity_;
        sim::Simulation::State state = simulation_.save();
        context_.check("saving a checkpoint");  // what a lost device gives back is nothing to go on from
        checkpoint.steps = state.steps_done;
        checkpoint.sections = std::move(state.parts);
        const double so_far = seconds();
        checkpoint.add(kSeconds, std::as_bytes(std::span(&so_far, 1)));
        checkpoint.add(kMotion, maker_.recorder().save());
        if (const EmptyWatch* empty = maker_.emptyWatch()) checkpoint.add(kWhoWasThere, empty->save());
        if (!vehicles_.empty()) checkpoint.add(kVehicleTrack, std::as_bytes(std::span(vehicles_)));
        if (!lifts_.empty()) checkpoint.add(kLiftTrack, std::as_bytes(std::span(lifts_)));
        if (!doors_.empty()) checkpoint.add(kDoorTrack, std::as_bytes(std::span(doors_)));
        writer_.save(std::move(checkpoint));
        last_checkpoint_ = Clock::now();
    }

    /// Of simulating, with what earlier runs took.
    double seconds() const { return seconds_before_ + secondsSince(start_); }

  private:
    static void takeTrack(const io::Checkpoint& checkpoint, const char* name, std::vector<float>& track) {
        const std::vector<std::byte>* bytes = checkpoint.find(name);
        if (!bytes) return;
        track.resize(bytes->size() / sizeof(float));
        std::memcpy(track.data(), bytes->data(), track.size() * sizeof(float));
    }

    /// @returns false where it was stopped; what there is to save is then the frame before
    bool makeFrame(std::uint32_t frame) {
        std::optional<sim::Simulation::State> before;
        if (simulation_.canStopWithinStep()) before = simulation_.save();
        const bool made = maker_.makeFrame(frame);
        if (!made && before) simulation_.restore(*before);
        return made;
    }

    void receive(const Frame& frame) {
        writer_.writeDiagram(frame);
        vehicles_.insert(vehicles_.end(), frame.vehicles.begin(), frame.vehicles.end());
        writer_.showVehicles(vehicles_);
        lifts_.insert(lifts_.end(), frame.lifts.begin(), frame.lifts.end());
        doors_.insert(doors_.end(), frame.doors.begin(), frame.doors.end());
    }

    const gl::Context& context_;
    sim::Simulation& simulation_;
    const BakeJob& job_;
    io::BakeWriter& writer_;
    std::string identity_;
    std::uint32_t frames_;
    Clock::time_point start_ = Clock::now(), last_checkpoint_;
    double seconds_before_ = 0.0;
    std::vector<float> vehicles_;  // of all frames so far
    std::vector<float> lifts_;     // likewise
    std::vector<float> doors_;     // likewise
    FrameMaker maker_;             // last: its thread uses the others
};

void stop(BakeRun& run, Run& running, io::BakeWriter& writer, WhenStopped what) {
    if (run.frames == 0) what = WhenStopped::discard;
    switch (what) {
        case WhenStopped::discard:
            run.end = BakeRun::End::discarded;
            return;
        case WhenStopped::checkpoint:
            running.save();
            run.end = BakeRun::End::checkpointed;
            return;
        case WhenStopped::keep_partial:
            run.end = BakeRun::End::partial;
            running.finish();
            run.result = writer.finishPartial(run.account, run.timing);
            return;
    }
}

/// Hundreds of bytes a person, and all cells of all fields.
void forgetWhatTheDeviceHas(authoring::Scene& scene) {
    scene.people = {};
    scene.stages = {};
    scene.goals = {};
    scene.fields.fields = {};
    scene.detours.distances = {};
}

/// Mesa's software renderer wakes its threads for every pass: for small crowds that takes several times
/// longer than the work. It asks the environment, once.
gl::Context::Options contextFor(int device, std::size_t people) {
    constexpr int kKeepWhatIsSet = 0;
    if (static_cast<double>(people) < kWorthThreads) ::setenv("LP_NUM_THREADS", "0", kKeepWhatIsSet);
    return {device, false};
}

}  // namespace

Baker::Baker(int device, const std::string& shader_dir, std::size_t people)
    : context_(contextFor(device, people)), shaders_(shader_dir), costs_(costsFor(context_.device())) {
    shaders_.keepPrograms();
}

BakeRun Baker::bake(LoadedLayout& loaded, const BakeJob& job, const InterruptGuard& interrupt) {
    const Clock::time_point begin = Clock::now();
    const authoring::SimulationSettings& settings = loaded.scene.settings;
    recording::BakeDescription description = describeBake(loaded, job.options, device());
    description.diagram_every = job.diagram_every;
    if (job.diagram_every > 0) describePictures(loaded, description);
    description.asked = job.streams;
    askForBodies(description);
    const std::uint32_t frames = description.frames;
    const std::string identity = identityOf(loaded, job, device());
    description.inputs = identity;
    BakeRun run;
    if (const auto complete = job.resume ? findComplete(description, identity) : std::nullopt) {
        run.end = BakeRun::End::was_complete;
        run.frames = complete->frames;
        run.timing = {complete->manifest.value("/timing/wall_seconds"_json_pointer, 0.0),
                      complete->manifest.value("/timing/steps"_json_pointer, std::uint64_t{0})};
        return run;
    }
    std::optional<io::Checkpoint> checkpoint = findCheckpoint(description, job, identity);
    const std::unique_ptr<io::BakeWriter> writer = makeWriter(description, job, checkpoint);
    sim::Simulation simulation = simulate(loaded.scene);
    context_.check("setting up the simulation");
    forgetWhatTheDeviceHas(loaded.scene);

    Run running(context_, simulation, settings, job, *writer, description, identity);
    if (checkpoint) running.goOnFrom(*checkpoint);
    const std::uint32_t steps_before = simulation.stepsDone();
    run.setup_seconds = secondsSince(begin);
    {
        Progress progress(job.progress, frames, sim::warmupSteps(settings),
                          static_cast<std::uint32_t>(settings.substeps), steps_before);
        run.signal = running.simulate(interrupt, progress);
    }
    context_.check("simulating");
    run.timing.wall_seconds = running.seconds();
    run.timing.steps = running.steps();
    run.frames = running.frames();
    run.account = withAudience(simulation.account(), description.audience.size());
    context_.check("reading what became of everybody");
    if (run.signal)
        stop(run, running, *writer, job.when_stopped(run.signal, run.timing.wall_seconds));
    else {
        running.finish();
        run.result = writer->finish(run.account, run.timing);
    }
    return run;
}

}  // namespace throng::cli
