// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>

#include "sim/gl/program.h"
#include "tests/sim/gpu_test.h"

namespace throng::test {
namespace {

class GlTest : public GpuTest {};

const gl::Declaration kSum = {"test", {"shaders/cells/counts_sum.comp"}, {"Counts"}, {"GroupSums"}};
const gl::Declaration kBinStarts = {
    "test", {"shaders/diagram/bins_starts.comp"}, {"Counts", "GroupSums"}, {"BinStarts"}};

TEST(Devices, ListsAtLeastOneUsableDeviceWithItsName) {
    const std::vector<gl::Device> devices = gl::listDevices();
    ASSERT_FALSE(devices.empty());
    EXPECT_TRUE(devices.front().usable);
    EXPECT_FALSE(devices.front().name.empty());
    for (std::size_t i = 1; i < devices.size(); ++i)
        EXPECT_LE(devices[i - 1].software, devices[i].software);
}

TEST(Devices, RefusesADeviceThatDoesNotExist) {
    gl::Context::Options options;
    options.device = 1000;
    try {
        gl::Context context(options);
        FAIL() << "device 1000 was accepted";
    } catch (const gl::GraphicsError& error) {
        EXPECT_NE(std::string(error.what()).find("throng devices"), std::string::npos) << error.what();
    }
}

TEST_F(GlTest, DriversAreAskedToTellOfResets) {
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    EXPECT_EQ(strategy, GL_LOSE_CONTEXT_ON_RESET) << "a lost device would go unnoticed";
}

TEST_F(GlTest, UploadsAndDownloadsWhatWasPutIn) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{63}, std::size_t{1234}}) {
        std::vector<std::uint32_t> words(count);
        for (std::size_t i = 0; i < count; ++i)
            words[i] = static_cast<std::uint32_t>(i * 2654435761u);
        EXPECT_EQ(gl::makeBuffer("words", words).download<std::uint32_t>(count), words);
    }
}

TEST_F(GlTest, RefusesTransfersPastTheEndOfABuffer) {
    gl::Buffer buffer("small", 16);
    EXPECT_THROW(buffer.upload(std::vector<std::uint32_t>(5)), std::out_of_range);
    EXPECT_THROW(buffer.download<std::uint32_t>(4, 1), std::out_of_range);
}

TEST_F(GlTest, RefusesABufferLargerThanTheDeviceGives) {
    EXPECT_THROW(gl::Buffer("huge", std::size_t{1} << 44), gl::GraphicsError);
}

TEST_F(GlTest, RefusesToRunAProgramWithAnUnboundBlockOrUnsetUniform) {
    gl::ComputeProgram program(library, kSum);
    const gl::Buffer counts("counts", 4096);
    const gl::Buffer sums("sums", 4096);
    program.bind("Counts", counts);
    EXPECT_THROW(program.dispatch(1), std::logic_error);
    program.bind("GroupSums", sums);
    EXPECT_THROW(program.dispatch(1), std::logic_error);
    program.set("count_total", 1u);
    EXPECT_NO_THROW(program.dispatch(1));
    EXPECT_THROW(program.bind("NoSuchBlock", counts), std::logic_error);
    EXPECT_THROW(program.set("no_such_uniform", 1u), std::logic_error);
}

/// A folder of shaders that goes with the test.
class ShaderFolder {
  public:
    ShaderFolder() { std::filesystem::create_directories(path_); }
    ~ShaderFolder() { std::filesystem::remove_all(path_); }
    const std::filesystem::path& path() const { return path_; }
    void add(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name) << text;
    }

  private:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("throng_shaders_" + std::to_string(getpid()));
};

TEST_F(GlTest, QuotientsAndRemaindersAreThoseOfWholeNumbers) {
    const ShaderFolder folder;
    folder.add("test/quotients.comp", R"(
layout(local_size_x = 64) in;
layout(std430) readonly buffer Numbers { uvec2 numbers[]; };
layout(std430) writeonly buffer Results { uvec2 results[]; };
#include "shaders/shared/quotient.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(numbers.length())) results[i] = quotientAndRemainder(numbers[i].x, numbers[i].y);
}
)");
    std::vector<glm::uvec2> numbers;
    for (const std::uint32_t divisor : {1u, 2u, 3u, 7u, 63u, 64u, 1'234u, 4'095u, 65'537u, 1u << 20})
        for (const std::uint64_t quotient : {0u, 1u, 2u, 63u, 1'234u, 65'535u, 65'536u, (1u << 20) - 1u})
            for (const std::uint64_t rest : {0u, 1u, divisor / 2u, divisor - 1u})
                if (const std::uint64_t number = quotient * divisor + rest % divisor; number < 1ull << 32)
                    numbers.emplace_back(static_cast<std::uint32_t>(number), divisor);
    const gl::Buffer given = gl::makeBuffer("numbers", numbers), results("results", numbers.size() * 8);
    gl::ComputeProgram program(gl::ShaderLibrary(folder.path()),
                               {"test", {"shaders/test/quotients.comp"}, {"Numbers"}, {"Results"}});
    program.bindAll({{"Numbers", &given}, {"Results", &results}});
    program.dispatch(numbers.size());
    const auto found = results.download<glm::uvec2>(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_EQ(found[i], glm::uvec2(numbers[i].x / numbers[i].y, numbers[i].x % numbers[i].y))
            << numbers[i].x << " by " << numbers[i].y;
}

// No debug context here: drivers also report the deliberate mistake through KHR_debug.
TEST(Shaders, AreReadFromAFolderBeforeTheBinary) {
    const gl::Context context({});
    const ShaderFolder folder;
    folder.add("cells/counts_sum.comp", "this is not GLSL\n");
    const gl::ShaderLibrary edited(folder.path());
    try {
        gl::ComputeProgram program(edited, kSum);
        FAIL() << "compiled nonsense";
    } catch (const gl::GraphicsError& error) {
        EXPECT_NE(std::string(error.what()).find("shaders/cells/counts_sum.comp"), std::string::npos)
            << error.what();
    }
    EXPECT_NO_THROW(gl::ComputeProgram(edited, kBinStarts));
    EXPECT_THROW(gl::ComputeProgram(edited, {"test", {"shaders/none.comp"}, {}, {}}), gl::GraphicsError);
}

}  // namespace
}  // namespace throng::test
