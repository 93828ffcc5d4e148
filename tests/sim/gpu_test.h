// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "sim/gl/context.h"
#include "sim/gl/declaration.h"
#include "sim/gl/shader_source.h"

namespace throng::test {

/// A test with a debug context. Whatever KHR_debug has to say fails it.
class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        gl::Context::Options options;
        options.debug = true;
        context = std::make_unique<gl::Context>(options);
    }
    void TearDown() override {
        for (const std::string& message : context->debugMessages())
            ADD_FAILURE() << "OpenGL says: " << message;
        context->check("after the test");
    }

    /// Declares whatever the text of a shader allows: for tests of the shader itself.
    gl::Declaration everythingIn(const std::string& shader) const {
        gl::Declaration declaration{"test", {shader}, {}, {}};
        std::vector<std::string> files;
        for (const gl::Access& access : gl::accessIn(library.load(shader, {}, files))) {
            if (access.reads) declaration.reads.push_back(access.name);
            if (access.writes) declaration.writes.push_back(access.name);
        }
        return declaration;
    }

    std::unique_ptr<gl::Context> context;
    gl::ShaderLibrary library;
};

}  // namespace throng::test
