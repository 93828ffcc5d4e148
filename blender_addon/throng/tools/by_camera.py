# SPDX-License-Identifier: Apache-2.0
"""What operators have in common that change crowds by the scene's camera, or, by nothing, take that back."""
from ..crowd.queries import ChangesCrowds, changed_crowds
from ..people.library import LibraryError

NO_CAMERA = "The scene has no camera: add one, or choose By Nothing"
NO_BONES = ("Nobody here has bones to bend: people have who are shaped from a library of bodies "
            "(scripts/body_library.py)")


class Refused(Exception):
    """Why nothing is done, in a sentence."""


class ByCamera(ChangesCrowds):
    """An operator with a property `by` says in change(context, crowds) what is done, and gives a sentence about it; and
    in take_back(crowd) what else."""

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        chosen = changed_crowds(context)
        if self.by == "none":
            for crowd in chosen:
                self.take_back(crowd)
            return {"FINISHED"}
        try:
            if not context.scene.camera:
                raise Refused(NO_CAMERA)
            told = self.change(context, chosen)
        except (Refused, LibraryError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, told)
        return {"FINISHED"}
