// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram/vehicle_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <set>
#include <string>

#include "sim/benchmarks/proximity_benchmark.h"
#include "sim/diagram/diagram.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

using sim::DiagramMethod;

gpu::VehicleBox boxAt(glm::vec2 middle, float heading, float length, float half_width, float ahead = 0.0f) {
    const glm::vec2 along(std::cos(heading), std::sin(heading));
    gpu::VehicleBox box{};
    box.rear = middle - 0.5f * length * along;
    box.front = middle + 0.5f * length * along;
    box.ahead = box.front + ahead * along;
    box.half_width = half_width;
    box.speed = ahead;
    return box;
}

/// m, 0 inside.
double distanceTo(const gpu::VehicleBox& box, glm::dvec2 place) {
    const glm::dvec2 axis(box.front - box.rear);
    const double length = glm::length(axis);
    const glm::dvec2 along = axis / length, offset = place - 0.5 * glm::dvec2(box.front + box.rear);
    const double beyond = std::abs(glm::dot(offset, along)) - 0.5 * length;
    const double beside = std::abs(offset.y * along.x - offset.x * along.y) - double{box.half_width};
    return std::hypot(std::max(beyond, 0.0), std::max(beside, 0.0));
}

class VehicleCellsTest : public GpuTest {
  protected:
    static constexpr std::uint32_t kWidth = 301, kHeight = 197;
    static constexpr float kScale = 8.0f;  // px/m

    /// Some beside each other, some across the window's edge, one far outside, and one that is not there.
    std::vector<gpu::VehicleBox> boxes() const {
        std::vector<gpu::VehicleBox> all = {
            boxAt({8.0f, 6.0f}, 0.3f, 4.5f, 0.9f), boxAt({9.0f, 8.4f}, 0.3f, 4.5f, 0.9f),
            boxAt({20.0f, 12.0f}, 1.2f, 12.0f, 1.25f), boxAt({36.5f, 3.0f}, -2.6f, 4.5f, 0.9f),
            boxAt({-300.0f, 40.0f}, 0.0f, 28.0f, 1.2f)};
        all.resize(8);
        all[6] = boxAt({18.0f, 22.0f}, 3.0f, 1.8f, 0.3f);
        return all;
    }

    std::vector<gpu::DiagramSite> sites(std::uint32_t moving, std::uint32_t walls) const {
        std::mt19937 random(moving);
        std::uniform_real_distribution<float> x(-5.0f, kWidth + 5.0f), y(-5.0f, kHeight + 5.0f),
            radius(2.0f, 7.0f);
        std::vector<gpu::DiagramSite> all;
        for (std::uint32_t id = 0; id < moving + walls; ++id)
            all.push_back({{x(random), y(random)}, radius(random), id});
        return all;
    }

    /// What a pixel is by the definition.
    struct Pixel {
        std::uint32_t owner = gpu::NO_INDEX;
        double distance = 0.0;
        bool is_plain = true;  // near to one only, and at no edge
    };

    /// By the definition, whose reach a pixel is in.
    static Pixel pixelAt(glm::dvec2 centre, const std::vector<gpu::DiagramSite>& all,
                         const std::vector<gpu::VehicleBox>& vehicles) {
        double nearest = 1.0e9, second = 1.0e9;
        Pixel pixel;
        const auto offer = [&](double distance, double reach, std::uint32_t id) {
            if (std::abs(distance - reach) < 1.0e-3 || (distance > 0.0 && distance < 1.0e-3))
                pixel.is_plain = false;
            if (distance > reach) return;
            if (distance < nearest) {
                second = nearest;
                nearest = distance;
                pixel.owner = id;
            } else {
                second = std::min(second, distance);
            }
        };
        for (const gpu::DiagramSite& site : all)
            offer(glm::distance(glm::dvec2(site.position), centre), double{site.radius}, site.id);
        for (std::uint32_t i = 0; i < vehicles.size(); ++i)
            if (vehicles[i].half_width > 0.0f)
                offer(distanceTo(vehicles[i], centre / double{kScale}) * kScale, 5.0,
                      static_cast<std::uint32_t>(all.size()) + i);
        pixel.distance = nearest;
        if (nearest > 0.0 && second - nearest < 1.0e-3) pixel.is_plain = false;
        return pixel;
    }

    static std::vector<Pixel> pixelsOf(const std::vector<gpu::DiagramSite>& all,
                                       const std::vector<gpu::VehicleBox>& vehicles) {
        std::vector<Pixel> pixels;
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x)
                pixels.push_back(pixelAt(glm::dvec2(x, y) + 0.5, all, vehicles));
        return pixels;
    }

    /// How many pixels are not as the definition has them, those apart that are as near to one as to another.
    std::size_t wrongPixels(std::uint32_t moving, std::uint32_t walls, DiagramMethod method, bool paged,
                            const std::vector<gpu::VehicleBox>& vehicles) {
        return wrongPixels(moving, walls, method, paged, vehicles, pixelsOf(sites(moving, walls), vehicles));
    }

    std::size_t wrongPixels(std::uint32_t moving, std::uint32_t walls, DiagramMethod method, bool paged,
                            const std::vector<gpu::VehicleBox>& vehicles,
                            const std::vector<Pixel>& expected) {
        const std::vector<gpu::DiagramSite> all = sites(moving, walls);
        const auto count = static_cast<std::uint32_t>(vehicles.size());
        const gl::Definitions definitions = {{"TRAFFIC", "1"}, {"VEHICLES", std::to_string(count) + "u"}};
        const gl::Buffer box_buffer = gl::makeBuffer("boxes", [&] {
            std::vector<gpu::VehicleBox> room = vehicles;
            room.resize(gpu::MOST_VEHICLES);
            return room;
        }());
        sim::DiagramOptions options;
        options.method = method;
        options.width = kWidth;
        options.height = kHeight;
        options.largest_radius = 7.0f;
        options.live_capacity = moving;
        options.look = 20.0f;
        options.paged = paged;
        options.vehicles =
            sim::VehicleSites{&box_buffer,    definitions,    count,        moving + walls, 5.0f,
                              28.0f * kScale, 1.25f * kScale, {0.0f, 0.0f}, kScale};
        sim::Diagram diagram(library, options, std::span(all).subspan(moving));
        std::vector<std::uint32_t> slots(all.size());
        for (std::uint32_t i = 0; i < slots.size(); ++i)
            slots[i] = i;
        const gl::Buffer site_buffer = gl::makeBuffer("sites", all);
        const gl::Buffer dispatch = gl::makeBuffer("dispatch", sim::dispatchOf(moving));
        const gl::Buffer slot_buffer = gl::makeBuffer("slots", slots);
        diagram.connect({&site_buffer, &dispatch, &slot_buffer});
        diagram.build();
        diagram.build();  // nothing of the first one is left
        const auto owners = diagram.wholeOwners().download<std::uint32_t>(expected.size());
        const auto distances = diagram.measureDistances().download<float>(expected.size());
        std::size_t wrong = 0, of_vehicles = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const auto& [owner, distance, is_plain] = expected[i];
            of_vehicles += owner != gpu::NO_INDEX && owner >= moving + walls;
            if (!is_plain) continue;
            const bool near =
                owner == gpu::NO_INDEX || std::abs(std::sqrt(double{distances[i]}) - distance) < 1.0e-2;
            wrong += owners[i] != owner || !near;
        }
        EXPECT_GT(of_vehicles, 3'000u);  // the test sees them
        return wrong;
    }
};

TEST_F(VehicleCellsTest, AreWhatIsNearerToAVehicleThanToAnybodyElse) {
    for (const std::uint32_t people : {1u, 63u, 1234u}) {
        const std::vector<Pixel> expected = pixelsOf(sites(people, 40), boxes());
        for (const DiagramMethod method : {DiagramMethod::binned, DiagramMethod::per_site,
                                           DiagramMethod::per_pixel, DiagramMethod::gradient1})
            EXPECT_EQ(wrongPixels(people, 40, method, false, boxes(), expected), 0u)
                << people << ' ' << authoring::wordFor(method);
    }
}

TEST_F(VehicleCellsTest, AreTheSameInPages) {
    for (const std::uint32_t people : {1u, 63u, 1234u})
        EXPECT_EQ(wrongPixels(people, 40, DiagramMethod::binned, true, boxes()), 0u) << people;
}

/// A jam of more than anybody lists, most of them in each other, and a column that waits outside the window.
TEST_F(VehicleCellsTest, AreRightInAJam) {
    std::vector<gpu::VehicleBox> jam;
    for (int i = 0; i < 40; ++i)
        jam.push_back(boxAt({10.0f + 0.3f * static_cast<float>(i), 8.0f + 0.13f * static_cast<float>(i)},
                            0.4f, 4.5f, 0.9f));
    for (int i = 0; i < 40; ++i)
        jam.push_back(boxAt({-20.0f - 6.0f * static_cast<float>(i), 8.0f}, 0.0f, 4.5f, 0.9f));
    jam.resize(128);
    for (const bool paged : {false, true})
        EXPECT_EQ(wrongPixels(63, 40, DiagramMethod::binned, paged, jam), 0u) << paged;
    std::reverse(jam.begin(), jam.begin() + 80);
    EXPECT_EQ(wrongPixels(63, 40, DiagramMethod::binned, false, jam), 0u);
}

/// Which vehicles people heed.
class HeededVehiclesTest : public GpuTest {
  protected:
    using Lists = std::vector<std::set<std::uint32_t>>;

    static authoring::Scene sceneWithLane() {
        authoring::Scene scene = emptyScene({-40.0f, -40.0f}, {40.0f, 40.0f});
        scene.traffic.lane_points = {{{-30.0f, -39.0f}, 0.0f, 0}, {{30.0f, -39.0f}, 60.0f, 0}};
        scene.traffic.lanes = {{0, 2, 0, 0, 60.0f, 0}};
        gpu::Vehicle car{};
        car.length = 4.5f;
        car.half_width = 0.9f;
        scene.traffic.vehicles.assign(5, car);
        return scene;
    }

    Lists heeded(authoring::Scene scene, const std::vector<gpu::VehicleBox>& boxes,
                 authoring::Proximity proximity) {
        scene.settings.proximity = proximity;
        sim::Simulation simulation(scene, library);
        sim::Buffers& buffers = simulation.parts().buffers;
        buffers.vehicle_boxes.upload(std::span<const gpu::VehicleBox>(boxes));
        sim::senseNow(simulation);
        const std::uint32_t capacity = buffers.slotCapacity();
        const auto most = static_cast<std::uint32_t>(scene.settings.neighbours);
        const auto words = buffers.neighbours.download<std::uint32_t>(capacity, std::size_t{most} * capacity);
        const auto bodies = buffers.bodies.download<gpu::Body>(scene.people.size());
        Lists lists(scene.people.size());
        for (std::size_t slot = 0; slot < bodies.size(); ++slot)
            for (std::uint32_t i = 0; i < gpu::MOST_HEEDED; ++i) {
                const std::uint32_t vehicle = words[slot] >> i * gpu::HEEDED_BITS & gpu::HEEDED_NONE;
                if (vehicle != gpu::HEEDED_NONE) lists[bodies[slot].row].insert(vehicle);
            }
        return lists;
    }
};

TEST_F(HeededVehiclesTest, AreThoseSeenFeltAndHeard) {
    // A car that stands along y, its side at x = 0.9, and people who look at it and away from it.
    const std::vector<gpu::VehicleBox> standing = {boxAt({0.0f, 0.0f}, 1.5707963f, 4.5f, 0.9f)};
    const std::vector<gpu::VehicleBox> coming = {boxAt({0.0f, 0.0f}, 1.5707963f, 4.5f, 0.9f, 12.0f)};
    authoring::Scene scene = sceneWithLane();
    addPerson(scene, {3.2f, 0.0f}, {-20.0f, 0.0f});    // looks at it, 2.3 m away
    addPerson(scene, {-3.2f, 0.0f}, {-20.0f, 0.0f});   // looks away
    addPerson(scene, {-1.5f, 1.5f}, {-20.0f, 1.5f});   // looks away, 0.6 m from it
    addPerson(scene, {0.5f, 9.0f}, {0.5f, 20.0f});     // looks away, before it
    addPerson(scene, {9.0f, -3.0f}, {-20.0f, -3.0f});  // looks at it from too far away
    for (const authoring::Proximity proximity :
         {authoring::Proximity::voronoi, authoring::Proximity::grid, authoring::Proximity::brute}) {
        const Lists stands = heeded(scene, standing, proximity), comes = heeded(scene, coming, proximity);
        const Lists expected_standing = {{0}, {}, {0}, {}, {}}, expected_coming = {{0}, {}, {0}, {0}, {}};
        EXPECT_EQ(stands, expected_standing) << static_cast<int>(proximity);
        EXPECT_EQ(comes, expected_coming) << static_cast<int>(proximity);
    }
}

TEST_F(HeededVehiclesTest, AreNearlyTheSameByTheDiagramAsExactly) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-12.0f, 12.0f);
    for (const int people : {1, 63, 234}) {
        authoring::Scene scene = sceneWithLane();
        std::vector<gpu::VehicleBox> boxes;
        for (int i = 0; i < 5; ++i)
            boxes.push_back(boxAt({place(random), place(random)}, place(random), 4.5f, 0.9f));
        while (static_cast<int>(scene.people.size()) < people) {
            const glm::vec2 at{place(random), place(random)};
            bool free = true;
            for (const gpu::VehicleBox& box : boxes)
                free = free && distanceTo(box, at) > 0.3;
            for (const gpu::Person& other : scene.people)
                free = free && glm::distance(other.spawn_position, at) > 0.5f;
            if (free) addPerson(scene, at, {place(random), place(random)});
        }
        const Lists seen = heeded(scene, boxes, authoring::Proximity::voronoi);
        const Lists exact = heeded(scene, boxes, authoring::Proximity::brute);
        std::size_t all = 0, found = 0, more = 0;
        for (std::size_t row = 0; row < seen.size(); ++row) {
            for (const std::uint32_t vehicle : exact[row]) {
                ++all;
                found += seen[row].count(vehicle);
            }
            for (const std::uint32_t vehicle : seen[row])
                more += 1 - exact[row].count(vehicle);
        }
        std::printf("    %d people: %zu of %zu, and %zu more whose nearest point is not in view\n", people,
                    found, all, more);
        EXPECT_GE(static_cast<double>(found), 0.95 * static_cast<double>(all)) << people;
    }
}

}  // namespace
}  // namespace throng::test
