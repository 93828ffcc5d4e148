// SPDX-License-Identifier: Apache-2.0
#include "io/bake_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "authoring/link_kinds.h"
#include "base/files/input_file.h"
#include "base/json_shape.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostBytes = std::uint64_t{32} << 20;  // of bake.json
constexpr double kFurthest = 4.0e9;                            // m from the origin, of anything
constexpr double kLeastRate = 1.0, kMostRate = 1000.0;         // frames/s
constexpr double kLongest = 100'000.0;                         // s

/// Reads members of the manifest, or of an object in it; every error names the file and the member.
class ManifestReader {
  public:
    ManifestReader(const fs::path& path, const Json& json, std::string pointer = {})
        : path_(path), json_(json), pointer_(std::move(pointer)) {}

    [[noreturn]] void fail(const std::string& member, const std::string& expected) const {
        throw InputError(path_, fmt::format("`{}{}` is missing or not {}", pointer_, member, expected));
    }

    bool has(const std::string& member) const { return json_.contains(Json::json_pointer(member)); }
    const Json& at(const std::string& member) const {
        const Json::json_pointer where(member);
        if (!json_.contains(where)) fail(member, "what it should be");
        return json_.at(where);
    }
    const Json& list(const std::string& member) const {
        const Json& value = at(member);
        if (!value.is_array()) fail(member, "a list");
        return value;
    }
    /// Calls read(reader) for each item of a list.
    template <class Read>
    void each(const std::string& member, Read read) const {
        const Json& items = list(member);
        for (std::size_t i = 0; i < items.size(); ++i)
            read(ManifestReader(path_, items[i], fmt::format("{}{}/{}", pointer_, member, i)));
    }
    std::string text(const std::string& member) const {
        const Json& value = at(member);
        if (!value.is_string()) fail(member, "a text");
        return value.get<std::string>();
    }
    bool flag(const std::string& member) const {
        const Json& value = at(member);
        if (!value.is_boolean()) fail(member, "true or false");
        return value.get<bool>();
    }
    double number(const std::string& member, double least = -1.0e300, double most = 1.0e300) const {
        return numberOf(at(member), member, least, most);
    }
    /// m.
    double length(const std::string& member) const { return number(member, 0.0, kFurthest); }
    std::uint64_t count(const std::string& member, std::uint64_t largest) const {
        const Json& value = at(member);
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest) fail(member, "a count");
        return value.get<std::uint64_t>();
    }
    std::uint32_t count(const std::string& member) const {
        return static_cast<std::uint32_t>(count(member, 0xffffffffu));
    }
    glm::dvec2 point(const std::string& member) const { return pointOf(at(member), member); }
    std::vector<glm::dvec2> points(const std::string& member, std::size_t least) const {
        std::vector<glm::dvec2> result;
        for (const Json& item : list(member))
            result.push_back(pointOf(item, fmt::format("{}/{}", member, result.size())));
        if (result.size() < least) fail(member, fmt::format("a list of {} points or more", least));
        return result;
    }
    std::vector<double> numbers(const std::string& member) const {
        std::vector<double> result;
        for (const Json& item : list(member))
            result.push_back(numberOf(item, fmt::format("{}/{}", member, result.size()), -1.0e300, 1.0e300));
        return result;
    }

  private:
    double numberOf(const Json& value, const std::string& member, double least, double most) const {
        const double found = value.is_number() ? value.get<double>() : HUGE_VAL;
        if (!std::isfinite(found)) fail(member, "a number");
        if (found < least || found > most) fail(member, fmt::format("a number from {} to {}", least, most));
        return found;
    }
    glm::dvec2 pointOf(const Json& value, const std::string& member) const {
        if (!value.is_array() || value.size() < 2) fail(member, "a point");
        return {numberOf(value[0], member + "/0", -kFurthest, kFurthest),
                numberOf(value[1], member + "/1", -kFurthest, kFurthest)};
    }

    const fs::path& path_;
    const Json& json_;
    std::string pointer_;
};

Json parseManifest(const fs::path& path, const std::string& text) {
    if (const char* problem = tooMuchIn(text))
        throw InputError(path, std::string("not a manifest: it ") + problem);
    try {
        return Json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        throw InputError(path, std::string("not a manifest: ") + error.what());
    }
}

authoring::Wall wallOf(const ManifestReader& reader) {
    authoring::Wall wall;
    wall.id = reader.text("/id");
    wall.points = reader.points("/points", 2);
    wall.closed = reader.flag("/closed");
    wall.thickness = reader.length("/thickness");
    wall.height = reader.length("/height");
    if (reader.has("/gate")) {
        wall.open_at_start = reader.flag("/gate/open_at_start");
        wall.toggles = reader.numbers("/gate/toggles");
    }
    if (reader.has("/edge")) wall.is_edge = reader.flag("/edge");
    if (reader.has("/ground")) reader.point("/ground");
    return wall;
}

void readLevels(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/levels")) return;
    bake.has_grounds = reader.has("/terrain/surface") && reader.text("/terrain/surface") == "grounds";
    reader.each("/levels", [&](const ManifestReader& level) {
        bake.levels.push_back({level.text("/id"),
                               level.number("/height", -kFurthest, kFurthest),
                               level.points("/floor", 3),
                               {},
                               {},
                               level.has("/landing")});
    });
}

std::size_t levelNamed(const ManifestReader& reader, const Bake& bake, const std::string& member) {
    const std::string id = reader.text(member);
    const auto known = std::ranges::find(bake.levels, id, &authoring::Level::id);
    if (known == bake.levels.end()) reader.fail(member, "the id of a level");
    return static_cast<std::size_t>(known - bake.levels.begin());
}

/// The level that something says it lies on.
std::size_t levelOf(const ManifestReader& reader, const Bake& bake) {
    return reader.has("/level") ? levelNamed(reader, bake, "/level") : 0;
}

void readLinks(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/links")) return;
    reader.each("/links", [&](const ManifestReader& each) {
        authoring::Link link;
        link.id = each.text("/id");
        link.from = levelNamed(each, bake, "/from");
        link.to = levelNamed(each, bake, "/to");
        const std::vector<glm::dvec2> path = each.points("/path", 2);
        link.begin = path.front();
        link.end = path.back();
        if (link.begin == link.end) each.fail("/path", "a path of two places");
        link.width = each.length("/width");
        if (each.has("/heights")) link.heights = each.point("/heights");
        const std::string type = each.text("/type");
        const auto kind = std::ranges::find_if(authoring::kLinkKinds,
                                               [&](const auto& known) { return known.first == type; });
        if (kind == authoring::kLinkKinds.end()) each.fail("/type", "what links can be");
        link.kind = kind->second;
        bake.links.push_back(std::move(link));
    });
}

void readPatches(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/geometry/patches")) return;
    reader.each("/geometry/patches", [&](const ManifestReader& each) {
        authoring::Patch patch;
        patch.id = each.text("/id");
        patch.polygon = each.points("/polygon", 3);
        patch.cost = each.length("/cost");
        patch.pace = each.length("/pace");
        if (each.has("/size")) patch.size = each.length("/size");
        patch.from = each.length("/from");
        if (each.has("/until")) patch.until = each.length("/until");
        patch.level = levelOf(each, bake);
        bake.patches.push_back(std::move(patch));
    });
}

void readGeometry(const ManifestReader& reader, Bake& bake) {
    readLevels(reader, bake);
    readLinks(reader, bake);
    reader.each("/geometry/roads", [&](const ManifestReader& road) {
        bake.roads.push_back({road.text("/id"),
                              road.points("/centreline", 2),
                              road.length("/width"),
                              road.flag("/one_way"),
                              {},
                              levelOf(road, bake)});
    });
    reader.each("/geometry/areas", [&](const ManifestReader& area) {
        bake.areas.push_back({area.text("/id"), area.points("/polygon", 3), {}, levelOf(area, bake)});
    });
    readPatches(reader, bake);
    reader.each("/geometry/walls", [&](const ManifestReader& wall) {
        bake.walls.push_back(wallOf(wall));
        if (bake.hasStoreys()) bake.wall_ground.push_back(wall.point("/ground"));
    });
}

template <class Thing>
std::size_t indexNamed(const ManifestReader& reader, const std::vector<Thing>& things,
                       const std::string& member) {
    const auto known = std::ranges::find(things, reader.text(member), &Thing::id);
    if (known == things.end()) reader.fail(member, "an id that the bake has");
    return static_cast<std::size_t>(known - things.begin());
}

template <class Thing>
std::vector<std::size_t> indicesNamed(const ManifestReader& reader, const std::vector<Thing>& things,
                                      const std::string& member) {
    std::vector<std::size_t> found;
    reader.each(member, [&](const ManifestReader& name) { found.push_back(indexNamed(name, things, "")); });
    return found;
}

void readSignals(const ManifestReader& reader, authoring::Traffic& traffic) {
    reader.each("/geometry/traffic/signals", [&](const ManifestReader& each) {
        authoring::Signal signal;
        signal.id = each.text("/id");
        signal.offset = each.number("/offset", 0.0, kLongest);
        each.each("/phases", [&](const ManifestReader& part) {
            authoring::Phase phase;
            phase.name = part.text("/name");
            phase.seconds = part.number("/seconds", 0.0, kLongest);
            phase.crossings = indicesNamed(part, traffic.crossings, "/crossings");
            phase.lanes = indicesNamed(part, traffic.lanes, "/lanes");
            signal.phases.push_back(std::move(phase));
        });
        if (signal.phases.empty() || signal.cycle() <= 0.0) each.fail("/phases", "phases that take time");
        traffic.signals.push_back(std::move(signal));
    });
}

void readTraffic(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/geometry/traffic")) return;
    reader.each("/geometry/traffic/crossings", [&](const ManifestReader& crossing) {
        bake.traffic.crossings.push_back({crossing.text("/id"), crossing.points("/polygon", 3), {}});
    });
    reader.each("/geometry/traffic/lanes", [&](const ManifestReader& each) {
        authoring::Lane lane;
        lane.id = each.text("/id");
        lane.points = each.points("/points", 2);
        lane.width = each.length("/width");
        bake.traffic.lanes.push_back(std::move(lane));
    });
    readSignals(reader, bake.traffic);
    std::size_t lane = 0;
    reader.each("/geometry/traffic/lanes", [&](const ManifestReader& each) {
        each.each("/stops", [&](const ManifestReader& part) {
            authoring::LaneStop stop;
            stop.at = part.point("/at");
            if (part.has("/signal")) stop.signal = indexNamed(part, bake.traffic.signals, "/signal");
            bake.traffic.lanes[lane].stops.push_back(stop);
        });
        ++lane;
    });
}

void readVehicleList(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/vehicles")) return;
    reader.each("/vehicles/list", [&](const ManifestReader& vehicle) {
        bake.vehicles.push_back({vehicle.text("/flow"), vehicle.text("/kind"), vehicle.length("/length"),
                                 vehicle.length("/width"), vehicle.length("/height"),
                                 vehicle.length("/wheel")});
    });
}

void readDoorList(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/doors")) return;
    reader.each("/doors/list", [&](const ManifestReader& vehicle) {
        DoorIdentity doors;
        vehicle.each("/at",
                     [&](const ManifestReader& at) { doors.at.push_back(at.number("", 0.0, 1000.0)); });
        doors.width = vehicle.number("/width", 0.0, 1000.0);
        doors.left = vehicle.flag("/left");
        doors.right = vehicle.flag("/right");
        doors.capacity = static_cast<std::uint32_t>(vehicle.count("/capacity", 100000));
        bake.doors.push_back(std::move(doors));
    });
    if (bake.doors.size() != bake.vehicles.size())
        reader.fail("/doors/list", "as many as there are vehicles");
}

void readLiftList(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/lifts")) return;
    reader.each("/lifts/list", [&](const ManifestReader& each) {
        const auto angle = [](const ManifestReader& of) { return of.number("/doors", -720.0, 720.0); };
        LiftIdentity lift{
            each.text("/id"),
            {each.number("/at/0", -kFurthest, kFurthest), each.number("/at/1", -kFurthest, kFurthest)},
            {each.length("/size/0"), each.length("/size/1")},
            angle(each),
            each.length("/door_width"),
            static_cast<std::uint32_t>(each.count("/capacity", 100000)),
            {}};
        each.each("/stops", [&](const ManifestReader& stop) {
            lift.stops.push_back(
                {stop.text("/level"), stop.number("/height", -kFurthest, kFurthest), angle(stop)});
        });
        bake.lifts.push_back(std::move(lift));
    });
}

recording::BakeFlight flightFrom(const ManifestReader& reader, const std::string& at) {
    recording::BakeFlight flight{reader.points(at + "/line", 1), reader.numbers(at + "/heights"),
                                 reader.length(at + "/width")};
    if (flight.heights.size() != flight.line.size()) reader.fail(at + "/heights", "one for each point");
    return flight;
}

std::vector<double> heightsFrom(const ManifestReader& reader, const std::vector<glm::dvec2>& line) {
    std::vector<double> heights = reader.numbers("/heights");
    if (heights.size() != line.size()) reader.fail("/heights", "one for each point");
    return heights;
}

void readSeats(const ManifestReader& reader, Bake& bake) {
    if (!reader.has("/geometry/seats")) return;
    reader.each("/geometry/seats", [&](const ManifestReader& block) {
        recording::BakeSeats seats{block.text("/id"),
                                   block.length("/pitch"),
                                   block.length("/width"),
                                   block.number("/rise", 0.0, kFurthest),
                                   {}};
        block.each("/rows", [&](const ManifestReader& row) {
            seats.rows.push_back({row.points("/line", 2), row.number("/height", -kFurthest, kFurthest)});
            if (row.has("/heights")) seats.rows.back().heights = heightsFrom(row, seats.rows.back().line);
        });
        if (block.has("/ground")) seats.ground = block.number("/ground", -kFurthest, kFurthest);
        if (block.has("/aisles"))
            block.each("/aisles", [&](const ManifestReader& aisle) {
                seats.aisles.push_back({aisle.points("/line", 2), aisle.length("/width")});
                if (aisle.has("/heights"))
                    seats.aisles.back().heights = heightsFrom(aisle, seats.aisles.back().line);
                if (!aisle.has("/passage")) return;
                aisle.each("/flights", [&](const ManifestReader& flight) {
                    seats.aisles.back().flights.push_back(flightFrom(flight, ""));
                });
                seats.aisles.back().passage = flightFrom(aisle, "/passage");
            });
        bake.seats.push_back(std::move(seats));
    });
}

void readExtent(const ManifestReader& reader, Bake& bake) {
    bake.fps = reader.number("/fps", kLeastRate, kMostRate);
    bake.frames = reader.count("/frames");
    if (bake.frames > kLongest * bake.fps)
        reader.fail("/frames", fmt::format("the frames of at most {:.0f} s", kLongest));
    bake.agents = reader.count("/agents");
    bake.origin = reader.point("/origin");
    bake.minimum = reader.point("/bounds/min");
    bake.maximum = reader.point("/bounds/max");
    if (bake.minimum.x >= bake.maximum.x || bake.minimum.y >= bake.maximum.y)
        reader.fail("/bounds", "a rectangle with an area");
}

/// What only some read, and take for what it should be where it is there.
void checkTheRest(const ManifestReader& reader) {
    for (const char* text : {"/inputs", "/generator", "/terrain/surface", "/terrain/source"})
        if (reader.has(text)) reader.text(text);
    for (const char* number : {"/origin/2", "/terrain/lowest", "/terrain/highest", "/timing/wall_seconds"})
        if (reader.has(number)) reader.number(number, -kFurthest, kFurthest);
    if (reader.has("/variations")) reader.count("/variations");
    if (reader.has("/timing/steps")) reader.count("/timing/steps", ~std::uint64_t{0});
    for (const char* object : {"/terrain", "/device", "/account/refused_reasons"})
        if (reader.has(object) && !reader.at(object).is_object()) reader.fail(object, "an object");
}

/// A manifest may come from anywhere: nothing outside its folder is read because of what it says.
bool staysInside(const std::string& path) {
    const fs::path relative(path);
    return !path.empty() && relative.is_relative() &&
           std::ranges::none_of(relative, [](const fs::path& part) { return part == ".."; });
}

/// Those that the manifest does not name are there where every such bake has them.
StreamChoice readStreams(const ManifestReader& reader) {
    StreamChoice asked;
    for (const StreamInfo& info : kStreams)
        asked[info.id] = reader.has(fmt::format("/streams/{}", info.name));
    return streamsOf(reader.has("/terrain"), asked);
}

/// Where the manifest names none, they are those that every bake once had.
StreamFormats readFormats(const ManifestReader& reader, const StreamChoice& streams) {
    StreamFormats formats;
    bool names_any = false;
    for (const StreamFormatInfo& format : kStreamFormats) {
        bool is_of_all = true;
        for (const StreamInfo& info : kStreams) {
            const bool is_named = reader.has(fmt::format("/streams/{}/{}", info.name, format.name));
            names_any = names_any || is_named;
            is_of_all = is_of_all && (is_named || !streams[info.id]);
        }
        if (is_of_all) formats.add(format.id);
    }
    if (!names_any) return StreamFormats::standard();
    if (formats.isEmpty()) reader.fail("/streams", "streams that all have one form which this version reads");
    return formats;
}

void readFiles(const ManifestReader& reader, Bake& bake) {
    reader.each("/files", [&](const ManifestReader& file) {
        bake.files.push_back(
            {file.text("/path"), file.count("/bytes", ~std::uint64_t{0}), file.text("/xxh3")});
        if (!staysInside(bake.files.back().path)) file.fail("/path", "a path inside the bake");
    });
}

}  // namespace

ManifestFile readManifest(const fs::path& path) {
    ManifestFile file;
    file.path = fs::is_directory(path) ? path / "bake.json" : path;
    file.text = readFile(file.path, kMostBytes);
    file.json = parseManifest(file.path, file.text);
    if (!file.json.is_object() || file.json.value("format", Json()) != "throng bake")
        throw InputError(file.path, "not the manifest of a bake");
    return file;
}

Bake loadBake(const fs::path& path) {
    return bakeOf(readManifest(path));
}

Bake bakeOf(ManifestFile file) {
    const fs::path& manifest_path = file.path;
    Bake bake;
    bake.folder = manifest_path.has_parent_path() ? manifest_path.parent_path() : fs::path(".");
    bake.manifest = std::move(file.json);
    const ManifestReader reader(manifest_path, bake.manifest);
    if (reader.count("/version") != 1)
        throw InputError(manifest_path, "written by a newer version of Throng: its `version` is not 1");
    bake.name = reader.text("/name");
    bake.complete = reader.flag("/complete");
    readExtent(reader, bake);
    bake.seed = reader.count("/seed", ~std::uint64_t{0});
    readGeometry(reader, bake);
    readTraffic(reader, bake);
    readVehicleList(reader, bake);
    readDoorList(reader, bake);
    readLiftList(reader, bake);
    readSeats(reader, bake);
    bake.has_poses = bake.manifest.value("poses", false);
    bake.account = {reader.count("/account/agents"), reader.count("/account/spawned"),
                    reader.count("/account/walking"), reader.count("/account/arrived"),
                    reader.count("/account/refused")};
    bake.streams = readStreams(reader);
    bake.formats = readFormats(reader, bake.streams);
    readFiles(reader, bake);
    checkTheRest(reader);
    return bake;
}

}  // namespace throng::io
