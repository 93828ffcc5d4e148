// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "sim/gl/context.h"
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

    std::unique_ptr<gl::Context> context;
    gl::ShaderLibrary library;
};

}  // namespace throng::test
