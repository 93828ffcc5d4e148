# SPDX-License-Identifier: Apache-2.0
"""People of a stage with skeletons, by USD's own library."""
import numpy
import pytest

Usd = pytest.importorskip("pxr.Usd", reason="usd-core is not installed")
UsdGeom = pytest.importorskip("pxr.UsdGeom")
UsdSkel = pytest.importorskip("pxr.UsdSkel")

PROXIES = Usd.TraverseInstanceProxies()
_CACHES = []  # queries do not outlive them


def people_of(stage):
    """{row: prim}"""
    people = stage.GetPrimAtPath("/World/Crowd").GetChildren()
    return {int(prim.GetName().removeprefix("person")): prim for prim in people if prim.GetName().startswith("person")}


def skeleton_of(prim):
    """(root, binding, query of the skeleton) of a person."""
    root, cache = UsdSkel.Root(prim.GetChild("figure")), UsdSkel.Cache()
    _CACHES[:] = [cache]
    assert cache.Populate(root, PROXIES)
    binding, = cache.ComputeSkelBindings(root, PROXIES)
    query = cache.GetSkelQuery(binding.GetSkeleton())
    assert query.GetAnimQuery().GetPrim() == prim.GetChild("motion")
    return root, binding, query


def joints_of(prim, times):
    """{joint: places in the world, one for each time}"""
    _, _, query = skeleton_of(prim)
    names = [str(path).rpartition("/")[2] for path in query.GetJointOrder()]
    places = []
    for time in map(float, times):
        world = numpy.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(prim))
        places.append((numpy.array(query.ComputeJointSkelTransforms(time)) @ world)[:, 3, :3])
    return dict(zip(names, numpy.swapaxes(places, 0, 1)))
