// SPDX-License-Identifier: Apache-2.0
//
// Trajectories as text. The archive of Forschungszentrum Juelich has a row for each person and frame: person,
// frame, x, y and perhaps z, between spaces or tabs, after lines that begin with # and may say the frame rate
// ("# framerate: 25 fps") and the unit ("x/m", "x/cm"). CSV says in its first line what its columns are;
// without frames, it has seconds.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "analysis/compare/trajectories.h"
#include "base/files/input_file.h"
#include "base/numbers.h"

namespace throng::analysis {
namespace {

constexpr double kFurthest = 1.0e7;                    // m: no crowd is larger
constexpr double kMostNumber = 1.0e9;                  // of a person, and of a frame
constexpr double kLeastRate = 0.1, kMostRate = 1.0e4;  // frames in a second
constexpr std::string_view kBetween = " \t,;\r";

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return result;
}

struct Field {
    std::string_view text;
    std::size_t column;  // from 1
};

std::vector<Field> fieldsOf(std::string_view line) {
    std::vector<Field> fields;
    for (std::size_t at = line.find_first_not_of(kBetween); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(kBetween, at), line.size());
        fields.push_back({line.substr(at, end - at), at + 1});
        at = line.find_first_not_of(kBetween, end);
    }
    return fields;
}

/// Which field is which.
struct Columns {
    std::size_t person = 0, moment = 1, x = 2, y = 3;
    bool in_seconds = false;
    std::size_t least() const { return std::max({person, moment, x, y}) + 1; }
};

class TextReader {
  public:
    TextReader(const std::filesystem::path& path, const TrajectoryOptions& options)
        : path_(path), options_(options), text_(readFile(path, kMostTable)) {}

    Trajectories read() {
        std::size_t at = 0;
        while (at < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at), text_.size());
            ++line_;
            readLine(std::string_view(text_).substr(at, end - at));
            at = end + 1;
        }
        if (!rate_ && columns_.in_seconds) rate_ = rateOfSeconds();
        if (options_.rate) rate_ = options_.rate;
        if (!rate_)
            throw InputError(
                path_,
                "does not say how many frames a second has: expected a line `# framerate: 25`, or "
                "--fps 25");
        if (!(*rate_ >= kLeastRate && *rate_ <= kMostRate))
            throw InputError(path_, fmt::format("{:.6g} frames a second: expected {} to {}", *rate_,
                                                kLeastRate, kMostRate));
        const double metres = options_.metres.value_or(metres_.value_or(1.0));
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            rows_[i].place *= metres;
            if (columns_.in_seconds) rows_[i].frame = std::llround(seconds_[i] * *rate_);
        }
        Trajectories result;
        result.rate = *rate_;
        result.tracks = tracksOf(path_, std::move(rows_), result.people);
        return result;
    }

  private:
    [[noreturn]] void fail(std::size_t column, const std::string& what) const {
        throw InputError(path_, fmt::format("{}:{}: {}", line_, column, what));
    }

    void readLine(std::string_view line) {
        const std::vector<Field> fields = fieldsOf(line);
        if (fields.empty()) return;
        if (fields[0].text.starts_with('#')) return readComment(lower(line));
        if (rows_.empty() && !has_names_ && !finiteNumber(fields[0].text)) return readNames(fields);
        if (fields.size() < columns_.least())
            fail(line.size() + 1, fmt::format("expected {} numbers (person, frame, x, y), found {}",
                                              columns_.least(), fields.size()));
        Sighting row;
        row.line = line_;
        row.person = whole(fields[columns_.person], "a person");
        if (columns_.in_seconds)
            seconds_.push_back(number(fields[columns_.moment], "seconds", kMostNumber));
        else
            row.frame = whole(fields[columns_.moment], "a frame");
        row.place = {number(fields[columns_.x], "x", kFurthest), number(fields[columns_.y], "y", kFurthest)};
        rows_.push_back(row);
    }

    void readComment(const std::string& line) {
        const std::size_t rate = line.find("framerate");
        if (rate != std::string::npos && !rate_) {
            const std::size_t digits = line.find_first_of("0123456789", rate);
            double value = 0.0;
            if (digits != std::string::npos &&
                std::from_chars(line.data() + digits, line.data() + line.size(), value).ec == std::errc())
                rate_ = value;
        }
        if (line.find("/cm") != std::string::npos || line.find("in cm") != std::string::npos) metres_ = 0.01;
        if (line.find("x/m") != std::string::npos || line.find("in m") != std::string::npos)
            metres_ = metres_.value_or(1.0);
    }

    void readNames(const std::vector<Field>& fields) {
        has_names_ = true;
        const auto columnOf =
            [&](std::initializer_list<std::string_view> names) -> std::optional<std::size_t> {
            for (std::size_t i = 0; i < fields.size(); ++i)
                if (std::find(names.begin(), names.end(), lower(fields[i].text)) != names.end()) return i;
            return std::nullopt;
        };
        const auto person = columnOf({"id", "agent", "person", "personid", "pedestrianid"});
        const auto frame = columnOf({"frame", "fr"});
        const auto seconds = columnOf({"time", "t", "seconds", "time/s"});
        const auto x = columnOf({"x", "pos_x", "x/m"}), y = columnOf({"y", "pos_y", "y/m"});
        if (!person || !(frame || seconds) || !x || !y)
            fail(1,
                 "expected a person, a frame, x and y in each line, or first a line that names the columns: "
                 "id, "
                 "frame (or time), x, y");
        columns_ = {*person, frame ? *frame : *seconds, *x, *y, !frame};
    }

    double number(const Field& field, const char* what, double most) const {
        const std::optional<double> value = finiteNumber(field.text);
        if (!value || std::abs(*value) > most)
            fail(field.column, fmt::format("expected {}, a number up to {:g}, found `{}`", what, most,
                                           std::string(field.text.substr(0, 40))));
        return *value;
    }
    std::int64_t whole(const Field& field, const char* what) const {
        const double value = number(field, what, kMostNumber);
        if (value != std::floor(value))
            fail(field.column, fmt::format("expected {}, a whole number, found `{}`", what,
                                           std::string(field.text.substr(0, 40))));
        return static_cast<std::int64_t>(value);
    }

    /// Of moments told in seconds: the least time between two of them is a frame.
    std::optional<double> rateOfSeconds() const {
        const std::set<double> moments(seconds_.begin(), seconds_.end());
        double least = 1.0 / kLeastRate;
        for (auto it = moments.begin(), next = it; it != moments.end() && ++next != moments.end(); ++it)
            if (*next - *it > 1.0 / kMostRate) least = std::min(least, *next - *it);
        if (moments.size() < 2) return std::nullopt;
        // Seconds may be rounded: the mean of the gaps between frames that follow each other is not.
        double sum = 0.0, count = 0.0;
        for (auto it = moments.begin(), next = it; it != moments.end() && ++next != moments.end(); ++it)
            if (const double gap = *next - *it; gap > 1.0 / kMostRate && gap < 1.5 * least) {
                sum += gap;
                count += 1.0;
            }
        return count / sum;
    }

    const std::filesystem::path& path_;
    const TrajectoryOptions& options_;
    std::string text_;
    std::size_t line_ = 0;
    bool has_names_ = false;
    Columns columns_;
    std::optional<double> rate_, metres_;
    std::vector<Sighting> rows_;
    std::vector<double> seconds_;
};

}  // namespace

Trajectories readTrajectoryText(const std::filesystem::path& path, const TrajectoryOptions& options) {
    return TextReader(path, options).read();
}

}  // namespace throng::analysis
