// SPDX-License-Identifier: Apache-2.0
#include "authoring/family/family_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "authoring/family/named_files.h"
#include "authoring/layout/json_document.h"
#include "authoring/layout/layout_reader.h"
#include "authoring/layout/object_reader.h"
#include "base/files/input_file.h"
#include "base/json_shape.h"
#include "base/numbers.h"
#include "base/text/printable.h"

namespace throng::authoring {
namespace {

constexpr const char* kAxisHint =
    R"(for example {"set": "/flows/0/rate", "values": [0.5, 1, 2]} or {"set": "/simulation/seed", "range": [1, 10]})";

constexpr const char* kCasesHint =
    R"(for example {"name": "day", "cases": {"quiet": {"/flows/0/rate": 0.2}, "busy": {"/flows/0/rate": 2}}})";

constexpr std::size_t kLongestName = 200;
constexpr double kMostAxes = 3.0;  // of as many scenarios as there can be

class Reader {
  public:
    Reader(const JsonNode& root, std::filesystem::path folder, Diagnostics& diagnostics, const Schema& schema)
        : root_(root), folder_(std::move(folder)), diagnostics_(diagnostics), schema_(schema) {}

    Family read() {
        ObjectReader reader(root_, schema_.rule(), "the family", diagnostics_);
        if (!reader.isObject()) return {};
        family_.where = root_.where;
        reader.get("$schema");
        const JsonNode* version = reader.require("throng_family", "the format's version, 1");
        if (version && (version->kind != JsonNode::Kind::number || version->number != 1.0))
            diagnostics_.error(version->where, "this program reads families of version 1",
                               "write \"throng_family\": 1");
        reader.text("name", family_.name);
        reader.text("folder", family_.folder);
        const std::filesystem::path own = folder_.empty() ? "." : folder_;
        family_.folder = std::filesystem::absolute(own / family_.folder).lexically_normal().string();
        readBase(reader);
        readSampling(reader);
        if (const JsonNode* axes = reader.require("axes", "what varies"); axes && isList(*axes, "axes"))
            for (const JsonNode& axis : axes->items)
                readAxis(axis);
        if (const JsonNode* bake = reader.get("bake")) readBake(*bake);
        reader.finish();
        checkWhole();
        return std::move(family_);
    }

  private:
    bool isList(const JsonNode& node, const char* what) {
        if (node.kind == JsonNode::Kind::array && !node.items.empty()) return true;
        diagnostics_.error(node.where,
                           fmt::format("expected an array of {} with something in it, found {}", what,
                                       node.kind == JsonNode::Kind::array ? "nothing" : node.kindName()));
        return false;
    }

    void readBase(ObjectReader& reader) {
        const JsonNode* base = reader.get("base");
        const JsonNode* generate = reader.get("generate");
        if (!base == !generate) {
            diagnostics_.error(
                root_.where, "a family has either a `base` layout or a `generate` block",
                R"(for example "base": "street.json", or "generate": {"kind": "crossing", "arms": 5})");
            return;
        }
        if (generate) return readGenerator(*generate);
        if (base->kind == JsonNode::Kind::object) {
            family_.base = plainJson(*base);
            placeFiles(family_.base, folder_);
            family_.base_name = "the base layout";
        } else if (base->kind == JsonNode::Kind::text) {
            readBaseFile(*base);
        } else {
            diagnostics_.error(
                base->where, fmt::format("expected a layout or the path of one, found {}", base->kindName()));
        }
    }

    void readBaseFile(const JsonNode& base) {
        const std::filesystem::path path = folder_ / base.text;
        std::string text;
        try {
            text = readFile(path);
        } catch (const InputError& error) {
            diagnostics_.error(base.where, fmt::format("the base layout cannot be read: {}", error.what()),
                               "the path starts from the family's folder");
            return;
        }
        family_.base_name = base.text;
        Diagnostics of_layout;
        const auto layout = readLayout(text, {}, of_layout);
        for (const Diagnostic& entry : of_layout.entries)
            if (entry.severity == Severity::error)
                diagnostics_.add(
                    {Severity::error,
                     base.where,
                     "the base layout is wrong:\n  " + formatDiagnostic(entry, path.string(), text),
                     {}});
        if (layout) family_.base = Json::parse(text);
        if (family_.base.is_object()) family_.base.erase("$schema");  // its path would lead nowhere
        placeFiles(family_.base, path.parent_path());  // scenarios are read without a folder of their own
    }

    void readGenerator(const JsonNode& node) {
        ObjectReader reader(node, schema_.rule().property("generate"), "`generate`", diagnostics_);
        if (!reader.isObject()) return;
        family_.generator_where = node.where;
        Meanings<const Generator*> kinds;
        for (const Generator& generator : generators())
            kinds.emplace_back(generator.name, &generator);
        reader.require("kind", "which generator: crossing, corridor, streets, plaza or stadium");
        reader.choice("kind", kinds, family_.generator);
        if (!family_.generator) return;
        family_.base_name = family_.generator->name;
        for (const GeneratorParameter& parameter : family_.generator->parameters) {
            const std::string name(parameter.name);
            const JsonNode* value = reader.get(name);
            if (!value) continue;
            const auto number = numberOf(*value, {parameter.least, parameter.most}, diagnostics_);
            if (!number) continue;
            if (parameter.whole && *number != std::floor(*number))
                diagnostics_.error(value->where, fmt::format("`{}` is a whole number", name));
            else
                family_.generator_values.emplace_back(name, *number);
        }
        reader.finish();
    }

    void readSampling(ObjectReader& reader) {
        reader.choice("sampling",
                      {{"grid", Sampling::grid}, {"random", Sampling::random}, {"latin", Sampling::latin}},
                      family_.sampling);
        reader.integer("count", family_.count);
        reader.integer("seed", family_.seed);
    }

    void readTargets(ObjectReader& reader, const JsonNode& node, Axis& axis) {
        const JsonNode* set = reader.get("set");
        const JsonNode* parameter = reader.get("parameter");
        if (reader.get("cases")) {
            if (set || parameter)
                diagnostics_.error(node.where, "`cases` say themselves what they set",
                                   "leave `set` and `parameter` out");
            else
                reader.require("name", "what the cases have in common");
            return;
        }
        if (!set == !parameter) {
            diagnostics_.error(
                node.where,
                "an axis has either `set` (JSON pointers into the layout) or `parameter` (of the generator)",
                kAxisHint);
            return;
        }
        if (parameter) {
            reader.text("parameter", axis.parameter);
            axis.name = axis.parameter;
            return;
        }
        if (set->kind == JsonNode::Kind::array)
            for (const JsonNode& each : set->items)
                readPointer(each, axis);
        else
            readPointer(*set, axis);
        if (!axis.pointers.empty()) axis.name = shortNameOf(axis.pointers.front());
    }

    /// "/flows/by-id/north/rate" is "flows.north.rate".
    static std::string shortNameOf(std::string pointer) {
        const std::string by_id = fmt::format("/{}/", kById);
        for (std::size_t at = pointer.find(by_id); at != std::string::npos; at = pointer.find(by_id, at))
            pointer.erase(at, by_id.size() - 1);
        std::replace(pointer.begin(), pointer.end(), '/', '.');
        return pointer.substr(1);
    }

    void readPointer(const JsonNode& node, Axis& axis) {
        if (node.kind == JsonNode::Kind::text ? isPointer(node.text, node.where) : isPointer("", node.where))
            axis.pointers.push_back(node.text);
    }

    bool isPointer(const std::string& text, const SourcePosition& where) {
        if (!text.starts_with('/') || text.size() < 2) {
            diagnostics_.error(where, "expected a JSON pointer into the layout",
                               R"(for example "/flows/0/rate", or "/flows/by-id/north/rate")");
            return false;
        }
        if (static_cast<std::size_t>(std::ranges::count(text, '/')) > kMostDepth) {
            diagnostics_.error(where, fmt::format("this pointer is more than {} deep", kMostDepth));
            return false;
        }
        for (std::size_t at = text.find('~'); at != std::string::npos; at = text.find('~', at + 1))
            if (at + 1 == text.size() || (text[at + 1] != '0' && text[at + 1] != '1')) {
                diagnostics_.error(where, "this is no JSON pointer: a `~` stands before 0 or 1",
                                   "`~0` is a `~` in a key, `~1` a `/`");
                return false;
            }
        return true;
    }

    void readAxis(const JsonNode& node) {
        ObjectReader reader(node, schema_.definition("axis"), "an axis", diagnostics_);
        if (!reader.isObject()) return;
        Axis axis;
        axis.where = node.where;
        readTargets(reader, node, axis);
        reader.text("name", axis.name);
        axis.minimum = -HUGE_VAL;
        axis.maximum = HUGE_VAL;
        std::vector<std::string> found;
        for (const char* kind : {"values", "range", "uniform", "normal", "log_normal", "formula", "cases"})
            if (reader.get(kind)) found.emplace_back(kind);
        if (found.size() != 1)
            diagnostics_.error(
                node.where,
                fmt::format("an axis has one of `values`, `range`, `uniform`, `normal`, `log_normal`, "
                            "`formula`, `cases`; this one has {}",
                            found.empty() ? "none" : "several"),
                kAxisHint);
        else if (found[0] == "values")
            readValues(reader, axis);
        else if (found[0] == "range")
            readRange(reader, *reader.get("range"), axis);
        else if (found[0] == "formula")
            readFormula(reader, axis);
        else if (found[0] == "cases")
            readCases(reader, axis);
        else
            readDistribution(reader, found[0], axis);
        reader.finish();
        family_.axes.push_back(std::move(axis));
    }

    void readValues(ObjectReader& reader, Axis& axis) {
        const JsonNode& values = *reader.get("values");
        if (!isList(values, "values")) return;
        for (const JsonNode& value : values.items)
            axis.values.push_back(plainJson(value));
        readWeights(reader, axis);
    }

    void readWeights(ObjectReader& reader, Axis& axis) {
        const JsonNode* weights = reader.get("weights");
        if (!weights || !isList(*weights, "weights")) return;
        const Limits limits = reader.rule("weights").item().limits();
        for (const JsonNode& weight : weights->items)
            axis.weights.push_back(numberOf(weight, limits, diagnostics_).value_or(1.0));
        if (axis.weights.size() != axis.values.size())
            diagnostics_.error(weights->where, fmt::format("there are {} weights for {} values",
                                                           axis.weights.size(), axis.values.size()));
        if (family_.sampling == Sampling::grid)
            diagnostics_.error(weights->where, "a grid takes every value: weights mean nothing there",
                               R"(add "sampling": "random", "count": 100)");
    }

    /// Names of cases, and what each sets.
    void readCases(ObjectReader& reader, Axis& axis) {
        const JsonNode& cases = *reader.get("cases");
        if (cases.kind != JsonNode::Kind::object || cases.members.empty()) {
            diagnostics_.error(cases.where, "expected names of cases, each with what it sets", kCasesHint);
            return;
        }
        for (const JsonNode::Member& one : cases.members) {
            if (one.value.kind != JsonNode::Kind::object) {
                diagnostics_.error(
                    one.value.where,
                    fmt::format("expected what the case sets, JSON pointers and values, found {}",
                                one.value.kindName()),
                    kCasesHint);
                continue;
            }
            Axis::Settings settings;
            for (const JsonNode::Member& setting : one.value.members)
                if (isPointer(setting.key, setting.key_where))
                    settings.emplace_back(setting.key, plainJson(setting.value));
            axis.values.emplace_back(one.key);
            axis.cases.push_back(std::move(settings));
        }
        readWeights(reader, axis);
    }

    void readFormula(ObjectReader& reader, Axis& axis) {
        const JsonNode& node = *reader.get("formula");
        std::string text;
        reader.text("formula", text);
        axis.kind = Axis::Kind::formula;
        axis.formula_where = node.where;
        reader.boolean("whole", axis.whole);
        if (node.kind != JsonNode::Kind::text) return;
        try {
            axis.formula = Formula(text);
        } catch (const FormulaError& error) {
            diagnostics_.error(axis.formulaPlace(error.at), error.what(),
                               "for example \"2 * rate + 1\": axes by their names, + - * / ( ), min, max");
        }
    }

    /// Formulas are of numbers that are known by then.
    void checkFormula(const Axis& formula) {
        for (const auto& [name, at] : formula.formula.names()) {
            const auto axis = std::ranges::find(family_.axes, name, &Axis::name);
            const bool is_known = axis != family_.axes.end();
            const bool is_later = is_known && axis->kind == Axis::Kind::formula && &*axis >= &formula;
            std::string wrong;
            if (!is_known)
                wrong = fmt::format("there is no axis `{}`", name);
            else if (is_later)
                wrong = &*axis == &formula ? std::string("a formula is of other axes")
                                           : fmt::format("`{}` is a formula that comes later", name);
            else if (!std::ranges::all_of(axis->values, [](const Json& value) { return value.is_number(); }))
                wrong = fmt::format("`{}` is no number in every scenario", name);
            if (!wrong.empty())
                diagnostics_.error(formula.formulaPlace(at), wrong,
                                   is_known ? ""
                                            : "the axes' names are what their `name` says; give those one "
                                              "that have none");
        }
    }

    std::vector<double> numbersOf(ObjectReader& reader, const std::string& key, const char* meaning) {
        const SchemaRule rule = reader.rule(key);
        const std::size_t least = rule.leastItems();
        const Limits limits = rule.item().limits();
        const JsonNode& node = *reader.get(key);
        std::vector<double> numbers;
        if (node.kind == JsonNode::Kind::array && node.items.size() >= least &&
            node.items.size() <= rule.mostItems())
            for (const JsonNode& item : node.items)
                if (const auto number = numberOf(item, limits, diagnostics_)) numbers.push_back(*number);
        if (numbers.size() < least) diagnostics_.error(node.where, fmt::format("expected {}", meaning));
        return numbers;
    }

    double mostScenarios() const { return schema_.rule().property("count").limits().most; }

    void readRange(ObjectReader& reader, const JsonNode& node, Axis& axis) {
        const std::vector<double> range = numbersOf(reader, "range", "[from, to] or [from, to, step]");
        if (range.size() < 2) return;
        const double step = range.size() == 3 ? range[2] : 1.0;
        const double steps = std::floor((range[1] - range[0]) / step + 1.0e-9);
        if (step <= 0.0 || steps < 0.0) {
            diagnostics_.error(node.where,
                               "a range goes from the smaller number to the larger one, in steps above zero");
            return;
        }
        if (steps >= mostScenarios()) {
            diagnostics_.error(
                node.where,
                fmt::format("this range has {:.0f} values: a family can have at most {:.0f} scenarios",
                            steps + 1.0, mostScenarios()),
                R"(give larger steps, or draw from it: "uniform" with "sampling": "latin", "count": 1000)");
            return;
        }
        const bool whole =
            std::all_of(range.begin(), range.end(), [](double n) { return n == std::floor(n); });
        for (std::size_t i = 0; i <= static_cast<std::size_t>(steps); ++i) {
            const double value = range[0] + static_cast<double>(i) * step;
            axis.values.push_back(whole ? Json(static_cast<std::int64_t>(value))
                                        : Json(withDigits(value, 12)));
        }
    }

    void readDistribution(ObjectReader& reader, const std::string& kind, Axis& axis) {
        const JsonNode& node = *reader.get(kind);
        axis.kind = kind == "uniform"  ? Axis::Kind::uniform
                    : kind == "normal" ? Axis::Kind::normal
                                       : Axis::Kind::log_normal;
        const std::vector<double> numbers =
            numbersOf(reader, kind, kind == "uniform" ? "[least, most]" : "[mean, deviation]");
        if (numbers.size() < 2) return;
        axis.a = numbers[0];
        axis.b = numbers[1];
        reader.boolean("whole", axis.whole);
        if (axis.kind == Axis::Kind::uniform) {
            if (axis.b < axis.a)
                diagnostics_.error(node.where, "the least is above the most", "swap the two");
        } else {
            if (axis.b <= 0.0) diagnostics_.error(node.where, "a deviation is more than zero");
            reader.number("min", axis.minimum);
            reader.number("max", axis.maximum);
            if (axis.minimum >= axis.maximum) diagnostics_.error(node.where, "`min` is not below `max`");
        }
        if (family_.sampling == Sampling::grid)
            diagnostics_.error(node.where,
                               "a grid takes every value of its axes: a distribution has no end of them",
                               R"(add "sampling": "latin", "count": 100, or write a `range`)");
    }

    void readBake(const JsonNode& node) {
        ObjectReader reader(node, schema_.rule().property("bake"), "`bake`", diagnostics_);
        if (!reader.isObject()) return;
        reader.boolean("gltf", family_.bake.gltf);
        reader.boolean("keep", family_.bake.keep);
        for (const StreamInfo& info : kStreams)
            if (info.source == StreamSource::device)
                reader.boolean(std::string(info.name), family_.bake.streams[info.id]);
        reader.integer("diagrams", family_.bake.diagrams);
        readFormats(reader);
        reader.finish();
    }

    void readFormats(ObjectReader& reader) {
        std::string words = wordsOf(family_.bake.formats);
        reader.text("streams", words);
        const FormatsRead forms = throng::readFormats(words);
        if (!forms.problem.empty())
            diagnostics_.error(reader.get("streams")->where, forms.problem, R"(e.g. "streams": "npy")");
        else
            family_.bake.formats = forms.formats;
    }

    void checkWhole() {
        if (diagnostics_.hasErrors()) return;
        std::set<std::string> names;
        for (const Axis& axis : family_.axes) {
            std::string name = axis.name;
            for (char& letter : name)
                letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
            if (axis.name != printable(axis.name) || axis.name.empty() || axis.name.size() > kLongestName)
                diagnostics_.error(axis.where, fmt::format("`{}` is no name for an axis", axis.name),
                                   "a few letters, without control characters");
            if (!names.insert(name).second)
                diagnostics_.error(axis.where, fmt::format("there are two axes of the name `{}`", axis.name),
                                   "give one of them another `name`");
            checkFormula(axis);
            if (axis.parameter.empty()) continue;
            if (!family_.generator)
                diagnostics_.error(axis.where,
                                   "`parameter` is for generators, and this family has a base layout",
                                   "use `set` with a JSON pointer");
            else
                checkParameter(axis);
        }
        if (family_.sampling != Sampling::grid && family_.count == 0)
            diagnostics_.error(family_.where, "how many scenarios are to be drawn?", R"(add "count": 100)");
        if (family_.sampling == Sampling::grid && family_.count > 0)
            diagnostics_.error(
                family_.where,
                "a grid has as many scenarios as its axes have combinations: `count` means nothing",
                R"(leave it out, or add "sampling": "random")");
        // Every scenario knows its value on every axis.
        const double most_values = kMostAxes * mostScenarios();
        if (countOf(family_) <= mostScenarios() &&
            countOf(family_) * static_cast<double>(family_.axes.size()) > most_values)
            diagnostics_.error(family_.where,
                               fmt::format("{:.3g} scenarios of {} axes are too many (at most {:.0f} values)",
                                           countOf(family_), family_.axes.size(), most_values),
                               R"(give fewer, or draw from it: "sampling": "latin", "count": 1000)");
        if (countOf(family_) > mostScenarios())
            diagnostics_.error(family_.where,
                               fmt::format("{:.3g} scenarios are too many (at most {:.0f})", countOf(family_),
                                           mostScenarios()),
                               R"(draw from it: "sampling": "latin", "count": 1000)");
    }

    void checkParameter(const Axis& axis) {
        try {
            GeneratorValues(family_.generator->parameters)[axis.parameter];
        } catch (const std::invalid_argument& error) {
            diagnostics_.error(axis.where,
                               fmt::format("generator `{}`: {}", family_.generator->name, error.what()));
        }
    }

    const JsonNode& root_;
    std::filesystem::path folder_;
    Diagnostics& diagnostics_;
    const Schema& schema_;
    Family family_;
};

}  // namespace

const Schema& familyRules() {
    static const Schema schema(familySchema());
    return schema;
}

std::optional<Family> readFamily(std::string_view text, const std::filesystem::path& folder,
                                 Diagnostics& diagnostics, const Schema& schema) {
    const JsonNode root = parseJson(text, diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
    Family family = Reader(root, folder, diagnostics, schema).read();
    if (diagnostics.hasErrors()) return std::nullopt;
    return family;
}

}  // namespace throng::authoring
