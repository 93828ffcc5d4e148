// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "authoring/layout/layout_reader.h"
#include "base/motion_settings.h"

namespace throng::test {
namespace {

std::string valueOf(const MotionSettings& settings, const std::string& constant) {
    for (const auto& [name, value] : settings.definitions())
        if (name == constant) return value;
    return "not defined";
}

struct Read {
    std::optional<authoring::Layout> layout;
    authoring::Diagnostics diagnostics;
};

Read read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    Read result;
    result.layout = authoring::readLayout(text, overrides, result.diagnostics);
    return result;
}

TEST(MotionRules, KnowWhatTheTableSays) {
    const MotionSettings settings;
    EXPECT_EQ(settings.number("drive", "relaxation"), 0.5);
    EXPECT_TRUE(settings.isOn("cushion"));
    EXPECT_TRUE(settings.isOn("turning", "on_the_spot"));
    EXPECT_THROW(settings.number("drive", "enabled"), std::logic_error);
    for (const MotionParameter& parameter : motionParameters()) {
        EXPECT_LE(parameter.least, parameter.value) << parameter.rule << "." << parameter.name;
        EXPECT_GE(parameter.most, parameter.value) << parameter.rule << "." << parameter.name;
    }
}

TEST(MotionRules, AreConstantsOfTheShadersWrittenExactly) {
    MotionSettings settings;
    EXPECT_EQ(valueOf(settings, "DRIVE_RELAXATION"), "0.5");
    EXPECT_EQ(valueOf(settings, "IMPATIENCE_BEGINS"), "0.05");
    EXPECT_EQ(valueOf(settings, "ROOM_BY_TIME_TO_COLLISION_MOST"), "20.0");
    EXPECT_EQ(valueOf(settings, "CUSHION_ENABLED"), "true");
    const auto rows = motionParameters();
    const auto set = [&](std::string_view rule, std::string_view name, double value) {
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const MotionParameter& parameter) {
            return parameter.rule == rule && parameter.name == name;
        });
        settings.set(static_cast<std::size_t>(row - rows.begin()), value);
    };
    set("cushion", "enabled", 0.0);
    set("cushion", "rate", 1.0e-7);
    set("walking_behind", "begins", -0.25);
    EXPECT_EQ(valueOf(settings, "CUSHION_ENABLED"), "false");
    EXPECT_EQ(valueOf(settings, "CUSHION_RATE"), "1e-07");
    EXPECT_EQ(valueOf(settings, "WALKING_BEHIND_BEGINS"), "(-0.25)");
}

TEST(MotionRules, AreReadFromALayoutAndFromItsOverrides) {
    const Read found =
        read(R"({"throng": 1, "motion": {"headway": {"enabled": false}, "drive": {"most": 2.5}}})",
             {"motion.cushion.enabled=false", "motion.planted_feet.slip=0"});
    ASSERT_TRUE(found.layout);
    const MotionSettings& motion = found.layout->simulation.motion;
    EXPECT_FALSE(motion.isOn("headway"));
    EXPECT_FALSE(motion.isOn("cushion"));
    EXPECT_EQ(motion.number("drive", "most"), 2.5);
    EXPECT_EQ(motion.number("planted_feet", "slip"), 0.0);
    EXPECT_EQ(motion.number("drive", "relaxation"), 0.5);
}

TEST(MotionRules, MistakesAreToldWhereTheyAre) {
    const auto mistake = [](const std::string& text) {
        const Read found = read(text);
        EXPECT_FALSE(found.layout) << text;
        if (found.diagnostics.entries.empty()) return std::string("none");
        const authoring::Diagnostic& first = found.diagnostics.entries.front();
        return first.where.pointer() + ": " + first.message + " " + first.hint;
    };
    const std::string unknown = mistake(R"({"throng": 1, "motion": {"cushon": {"enabled": false}}})");
    EXPECT_NE(unknown.find("cushion"), std::string::npos) << unknown;
    const std::string parameter = mistake(R"({"throng": 1, "motion": {"drive": {"enabled": false}}})");
    EXPECT_NE(parameter.find("/motion/drive"), std::string::npos) << parameter;
    const std::string limit = mistake(R"({"throng": 1, "motion": {"drive": {"most": 1000}}})");
    EXPECT_NE(limit.find("/motion/drive/most"), std::string::npos) << limit;
    const std::string kind = mistake(R"({"throng": 1, "motion": {"headway": false}})");
    EXPECT_NE(kind.find("/motion/headway"), std::string::npos) << kind;
}

}  // namespace
}  // namespace throng::test
