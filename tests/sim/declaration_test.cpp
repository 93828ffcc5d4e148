// SPDX-License-Identifier: Apache-2.0
// What programs say that they touch, against what their shaders do.
#include "sim/gl/declaration.h"

#include "sim/gl/program.h"
#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

std::string describe(const std::vector<gl::Access>& accesses) {
    std::string text;
    for (const gl::Access& access : accesses)
        text += access.name + (access.reads ? " reads" : "") + (access.writes ? " writes" : "") + "; ";
    return text;
}

TEST(Access, IsReadOffTheQualifiersOfBlocksAndSamplers) {
    EXPECT_EQ(
        describe(gl::accessIn(R"(#version 450 core
layout(local_size_x = 64) in;
layout(std140) uniform ParametersBlock { Parameters parameters; };
layout(std430) readonly buffer People { Person people[]; };
layout(std430) writeonly buffer Bodies { Body bodies[2]; } named;
layout(std430) restrict coherent buffer States { AgentState states[]; };
layout(std430, binding = 3)
    buffer
    readonly Late { uint late[]; };
uniform usamplerBuffer owners;
uniform highp sampler2D one, two[3];
layout(r32ui) uniform writeonly uimage2D picture;
uniform uint steps_done;
uniform vec2 pattern[12];
shared uint sums[64];
struct Local { uint buffers; };
void main() { uint buffer_index = 0u; if (steps_done > 1u) { buffer_index = uint(pattern[0].x); } }
)")),
        "ParametersBlock reads; People reads; Bodies writes; States reads writes; Late reads; owners reads; "
        "one reads; two reads; picture writes; ");
}

TEST(Access, IsNotReadOffCommentsOrDirectives) {
    EXPECT_EQ(describe(gl::accessIn(R"(
// layout(std430) buffer InALine { uint a[]; };
/* layout(std430) buffer InAComment { uint b[]; };
   uniform sampler2D too; */
#define BLOCK buffer InADefinition { uint c[]; };
#define LONG_BLOCK \
    buffer InADefinition { \
        uint c[]
layout(std430) /* readonly */ buffer Real { uint d[]; };  // writeonly
)")),
              "Real reads writes; ");
}

TEST(Access, OfWhatStandsInTwoBranchesIsThatOfBoth) {
    EXPECT_EQ(describe(gl::accessIn("#ifdef A\nreadonly buffer Both { uint a[]; };\n#else\n"
                                    "writeonly buffer Both { uvec4 a[]; };\n#endif\n")),
              "Both reads writes; ");
}

/// What is wrong with a declaration, or nothing.
std::string complaint(const gl::Declaration& declaration, const std::vector<std::string>& active) {
    try {
        declaration.check({{"In", true, false}, {"Out", false, true}, {"Both", true, true}}, active);
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

TEST(Declarations, HaveToSayWhatTheShaderDoes) {
    const auto of = [](std::vector<std::string> reads, std::vector<std::string> writes) {
        return gl::Declaration{"sorting", {"shaders/sort.comp"}, std::move(reads), std::move(writes)};
    };
    const std::string head = "pass `sorting`: shaders/sort.comp ";
    EXPECT_EQ(complaint(of({"In", "Both"}, {"Out", "Both"}), {"In", "Out", "Both"}), "");
    EXPECT_EQ(complaint(of({"In", "Both"}, {"Out", "Both"}), {"Out"}), "");  // the driver needs no more
    EXPECT_EQ(complaint(of({"In"}, {"Out"}), {"In", "Out", "Both"}),
              head + "touches `Both`, which is not declared");
    EXPECT_EQ(complaint(of({"In", "Both"}, {"Out"}), {"Both"}),
              head + "may write `Both`, declared to be read only");
    EXPECT_EQ(complaint(of({"In"}, {"Both"}), {"Both"}),
              head + "may read `Both`, declared to be written only");
    EXPECT_EQ(complaint(of({}, {"In"}), {"In"}), head + "may read `In`, declared to be written only");
    EXPECT_EQ(complaint(of({"In"}, {"In"}), {"In"}), head + "cannot write `In`, declared to be written");
    EXPECT_EQ(complaint(of({"Out"}, {"Out"}), {"Out"}), head + "cannot read `Out`, declared to be read");
    EXPECT_EQ(complaint(of({"In", "Gone"}, {}), {"In"}), head + "has no `Gone`, which is declared");
}

class DeclarationTest : public GpuTest {
  protected:
    std::string complaintOf(std::vector<std::string> reads, std::vector<std::string> writes) {
        try {
            const gl::Declaration kept{"cells", {"shaders/cells/strips_fill.comp"}, reads, writes};
            gl::ComputeProgram program(library, kept);
        } catch (const std::logic_error& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(DeclarationTest, AProgramThatDoesOtherwiseDoesNotStart) {
    const std::vector<std::string> reads = {"FillDispatch", "StripList", "CellCounts"};
    const std::vector<std::string> writes = {"StripCounts", "StripMarks", "CellOffsets"};
    EXPECT_EQ(complaintOf(reads, writes), "");
    const std::string head = "pass `cells`: shaders/cells/strips_fill.comp ";
    EXPECT_EQ(complaintOf({"FillDispatch", "CellCounts"}, writes),
              head + "touches `StripList`, which is not declared");
    EXPECT_EQ(complaintOf({"FillDispatch", "StripList", "CellCounts", "CellOffsets"},
                          {"StripCounts", "StripMarks"}),
              head + "may write `CellOffsets`, declared to be read only");
}

TEST_F(DeclarationTest, APooledProgramIsCheckedAsWell) {
    library.keepPrograms();
    const std::string shader = "shaders/cells/counts_sum.comp";
    EXPECT_NO_THROW(gl::ComputeProgram(library, {"one", {shader}, {"Counts"}, {"GroupSums"}}));
    EXPECT_THROW(gl::ComputeProgram(library, {"other", {shader}, {}, {"GroupSums"}}), std::logic_error);
    library = gl::ShaderLibrary();  // before the context goes
}

TEST_F(DeclarationTest, AJournalKeepsWhatWasAskedOfTheDevice) {
    const gl::Buffer counts("counts", gl::Room{1024, 4, "cell"});
    gl::Buffer sums("sums", gl::Room{2, 4, "group"});
    gl::ComputeProgram sum(library, {"cells", {"shaders/cells/counts_sum.comp"}, {"Counts"}, {"GroupSums"}});
    sum.bind("Counts", counts);
    sum.bind("GroupSums", sums);
    sum.set("count_total", 1024u);
    sum.dispatch(1024);  // nobody looks
    const gl::Journal journal;
    EXPECT_THROW(gl::Journal(), std::logic_error);
    sums.fill(0);
    sum.dispatch(1024);
    const auto& commands = journal.commands();
    ASSERT_EQ(commands.size(), 2u);
    EXPECT_EQ(commands[0].what, "fill");
    EXPECT_EQ(commands[0].touches, (std::vector<gl::Touch>{{sums.contents(), false, true}}));
    EXPECT_EQ(commands[1].what, "shaders/cells/counts_sum.comp");
    ASSERT_EQ(commands[1].touches.size(), 2u);
    for (const gl::Touch& touch : commands[1].touches) {
        const bool is_counts = touch.contents == counts.contents();
        EXPECT_EQ(touch.reads, is_counts);
        EXPECT_EQ(touch.writes, !is_counts);
    }
    EXPECT_EQ(counts.contents()->per, "cell");
    EXPECT_EQ(counts.contents()->element_bytes, 4u);
}

TEST_F(DeclarationTest, AJournalTimesEachCommandWhereItIsTold) {
    gl::Buffer large("large", gl::Room{1 << 24, 4, "cell"}), small("small", gl::Room{4, 4, "cell"});
    gl::Journal journal(gl::Journal::Times::of_wall);
    large.fill(1);
    small.fill(2);
    const std::vector<double> times = journal.milliseconds();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_GT(times[0], times[1]) << "64 MiB beside 16 bytes";
    EXPECT_GE(times[1], 0.0);
}

TEST_F(DeclarationTest, AJournalWithoutAClockHasNoTimes) {
    gl::Journal journal;
    EXPECT_THROW(journal.milliseconds(), std::logic_error);
}

}  // namespace
}  // namespace throng::test
