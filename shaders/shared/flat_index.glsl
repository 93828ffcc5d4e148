// SPDX-License-Identifier: Apache-2.0
/// This invocation's number where a dispatch may have more groups than fit one axis (gl/program.h).
uint flatIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
