// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>

#include <filesystem>
#include <fstream>

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

// No debug context here: drivers also report the deliberate mistake through KHR_debug.
TEST(Shaders, AreReadFromAFolderBeforeTheBinary) {
    const gl::Context context({});
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "throng_shader_folder_test";
    std::filesystem::create_directories(folder / "cells");
    std::ofstream(folder / "cells" / "counts_sum.comp") << "this is not GLSL\n";
    const gl::ShaderLibrary edited(folder);
    try {
        gl::ComputeProgram program(edited, kSum);
        FAIL() << "compiled nonsense";
    } catch (const gl::GraphicsError& error) {
        EXPECT_NE(std::string(error.what()).find("shaders/cells/counts_sum.comp"), std::string::npos)
            << error.what();
    }
    EXPECT_NO_THROW(gl::ComputeProgram(edited, kBinStarts));
    EXPECT_THROW(gl::ComputeProgram(edited, {"test", {"shaders/none.comp"}, {}, {}}), gl::GraphicsError);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace throng::test
