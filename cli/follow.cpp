// SPDX-License-Identifier: Apache-2.0
#include "cli/follow.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "analysis/follow/account.h"
#include "analysis/follow/plot.h"
#include "analysis/follow/table.h"
#include "authoring/scene/audience.h"
#include "base/files/output_file.h"
#include "cli/baking/baker.h"
#include "cli/baking/device_fields.h"
#include "cli/terminal/say.h"
#include "sim/follow/follower.h"

namespace throng::cli {
namespace {

/// m: recorded places are means over time, and lie this near to those of the simulation where both go the
/// same way.
constexpr double kSameWay = 0.5;

void checkRequest(const io::Bake& bake, const FollowRequest& request) {
    for (const std::uint32_t row : request.rows)
        if (row >= bake.agents)
            throw CLI::ValidationError("--follow", bake.agents == 0
                                                       ? fmt::format("there is nobody in {}", bake.name)
                                                       : fmt::format("{} has rows 0 to {}, and no row {}",
                                                                     bake.name, bake.agents - 1, row));
    if (request.from >= request.to)
        throw CLI::ValidationError(
            "--to", fmt::format("{} s is not after {} s, where it begins", request.to, request.from));
}

/// The ground that a bake has is in the world's coordinates; the file that its layout names may be gone. That
/// of storeys has floors and links built into it, and is no layout's.
std::vector<std::string> itsTerrain(const io::Bake& bake) {
    if (bake.hasStoreys() || !std::filesystem::exists(bake.folder / "terrain.glb")) return {};
    return {"terrain.file=terrain.glb", "terrain.node=terrain", "terrain.scale=1",
            "terrain.offset=[0, 0, 0]"};
}

LoadedLayout layoutOf(const io::Bake& bake, const FollowRequest& request) {
    const std::filesystem::path path = bake.folder / "layout.json";
    if (!std::filesystem::exists(path))
        throw InputError(bake.folder, "has no layout.json, which --follow simulates anew");
    LoadedLayout loaded = loadLayout(path.string(), itsTerrain(bake), [&] {
        return makeDeviceFields(FieldsBy::automatic, request.device, "");
    });
    const std::size_t walkers = loaded.scene.people.size();
    const std::size_t people = walkers + authoring::audienceOf(loaded.layout).size();
    if (people != bake.agents)
        throw InputError(path, fmt::format("makes {} people, and the bake has {}: it is not its layout",
                                           people, bake.agents));
    for (const std::uint32_t row : request.rows)
        if (row >= walkers)
            throw CLI::ValidationError(
                "--follow", fmt::format("row {} of {} has a seat: it decides nothing", row, bake.name));
    return loaded;
}

/// In the plane people are where their charts lie.
void goHome(FollowedStep& step, const authoring::ChartMap& map) {
    const glm::vec2 by = map.home(step.place) - step.place;
    step.place_before = map.home(step.place_before);
    step.place += by;
    step.goal = map.home(step.goal);
    for (SensedPerson& other : step.sensed)
        other.place += by;  // as seen from there
}

/// The layout, simulated anew.
class Run {
  public:
    Run(io::CrowdReader& crowd, const LoadedLayout& loaded, const FollowRequest& request)
        : crowd_(crowd),
          scene_(loaded.scene),
          request_(request),
          warmup_(sim::warmupSteps(scene_.settings)),
          substeps_(static_cast<std::uint32_t>(scene_.settings.substeps)),
          baker_(request.device, "", scene_.people.size()),
          simulation_(baker_.simulate(scene_)) {
        if (request.folder.empty()) return;
        makeFolder(request.folder);
        tables_ = std::make_unique<analysis::FollowTables>(request.folder, scene_.origin);
    }

    void simulate() {
        const std::uint32_t last = warmup_ + (std::max(crowd_.frames(), 1u) - 1) * substeps_;
        std::unique_ptr<sim::Follower> follower;
        for (std::uint32_t step = 1; step <= last && timeAfter(step - 1) < request_.to; ++step) {
            if (timeAfter(step) <= request_.from) {
                simulation_.step();
                continue;
            }
            if (!follower) follower = std::make_unique<sim::Follower>(simulation_, scene_, request_.rows);
            std::vector<FollowedStep> looks = follower->step();
            for (FollowedStep& look : looks)
                goHome(look, scene_.chart_map);
            if (tables_) tables_->write(looks);
            for (const FollowedStep& look : looks)
                take(look);
            if (follower->allHaveLeft()) break;
        }
        baker_.context().check("following people");
        if (tables_) tables_->finish();
    }

    std::vector<analysis::FollowAccount> accounts() const {
        std::vector<analysis::FollowAccount> list;
        for (const auto& [row, steps] : steps_)
            list.push_back(analysis::accountOf(steps, stepSeconds(), scene_.origin));
        return list;
    }

    void plot(const analysis::FollowAccount& account) const {
        std::vector<authoring::Wall> walls = crowd_.bake().walls;
        for (authoring::Wall& wall : walls)
            for (glm::dvec2& point : wall.points)
                point += crowd_.bake().origin;
        analysis::writeFollowPlot(
            std::filesystem::path(request_.folder) / fmt::format("follow-{}.png", account.row),
            {fmt::format("Row {} of {}", account.row, crowd_.bake().name), steps_.at(account.row),
             stepSeconds(), scene_.origin, walls, account});
    }

    /// m, from the places that the bake has of those who are followed.
    double furthestOff() const { return furthest_off_; }

  private:
    double stepSeconds() const { return 1.0 / (scene_.settings.fps * substeps_); }
    double timeAfter(std::uint32_t steps) const {
        return (static_cast<double>(steps) - warmup_) * stepSeconds();
    }

    void take(const FollowedStep& look) {
        steps_[look.row].push_back(look);
        // Once a second is enough to see whether the bake went the same way.
        const auto every = substeps_ * std::max(static_cast<std::uint32_t>(scene_.settings.fps), 1u);
        if (look.step < warmup_ || (look.step - warmup_) % every != 0) return;
        const io::CrowdFrame frame = crowd_.frame((look.step - warmup_) / substeps_);
        if (!frame.isThere(look.row)) return;
        const glm::dvec2 place = scene_.origin + glm::dvec2(look.place) - crowd_.bake().origin;
        furthest_off_ = std::max(furthest_off_, glm::distance(place, frame.place(look.row)));
    }

    io::CrowdReader& crowd_;
    const authoring::Scene& scene_;
    const FollowRequest& request_;
    std::uint32_t warmup_, substeps_;
    Baker baker_;
    sim::Simulation simulation_;
    std::unique_ptr<analysis::FollowTables> tables_;
    std::map<std::uint32_t, std::vector<FollowedStep>> steps_;
    double furthest_off_ = 0.0;
};

void tell(const Run& run, const std::vector<analysis::FollowAccount>& accounts,
          const FollowRequest& request) {
    if (request.json) {
        nlohmann::ordered_json people = nlohmann::ordered_json::array();
        for (const analysis::FollowAccount& account : accounts)
            people.push_back(analysis::followJson(account));
        sayJson({{"furthest_off", run.furthestOff()}, {"people", people}});
    } else {
        for (const analysis::FollowAccount& account : accounts)
            fmt::print("{}", analysis::followText(account));
    }
    if (run.furthestOff() > kSameWay)
        say(stderr,
            "throng: the bake's people are up to {:.1f} m from where they were followed: it was baked on "
            "another device or by another build, and what is told is what happens here\n",
            run.furthestOff());
}

}  // namespace

void followPeople(io::CrowdReader& crowd, const FollowRequest& told) {
    FollowRequest request = told;
    std::ranges::sort(request.rows);
    request.rows.erase(std::ranges::unique(request.rows).begin(), request.rows.end());
    checkRequest(crowd.bake(), request);
    const LoadedLayout loaded = layoutOf(crowd.bake(), request);
    Run run(crowd, loaded, request);
    run.simulate();
    const std::vector<analysis::FollowAccount> accounts = run.accounts();
    for (const std::uint32_t row : request.rows)
        if (std::ranges::find(accounts, row, &analysis::FollowAccount::row) == accounts.end())
            say(stderr, "throng: row {} is not there in that time\n", row);
    if (accounts.empty())
        throw InputError(crowd.bake().folder, "has none of those who are to be followed in that time");
    tell(run, accounts, request);
    if (request.folder.empty()) return;
    for (const analysis::FollowAccount& account : accounts)
        run.plot(account);
}

}  // namespace throng::cli
