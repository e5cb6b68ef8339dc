"""What all figures have in common."""

from __future__ import annotations

import pathlib

import anywidget
import ipywidgets
import traitlets

from ._options import Options

_HERE = pathlib.Path(__file__).parent


class Library(anywidget.AnyWidget):
    """The figures' script and programs, in one model that all figures of a kernel share: a saved notebook has them once."""

    _esm = "export default {}"
    _shared: Library | None = None

    script = traitlets.Unicode(help="What runs in the page.").tag(sync=True)

    @classmethod
    def shared(cls) -> Library:
        """The one there is; another one where it was closed."""
        if cls._shared is None or cls._shared.comm is None:
            cls._shared = cls(script=(_HERE / "static" / "fastslam-anywidget.js").read_text("utf-8"))
        return cls._shared


class Figure(anywidget.AnyWidget, Options):
    """A live figure. Its parameters are traits, in step with the figure in both directions."""

    _esm = _HERE / "loader.js"
    _parameters: tuple[str, ...] = ()

    library = traitlets.Instance(Library, help="What it is drawn with.").tag(sync=True, **ipywidgets.widget_serialization)
    readouts = traitlets.Dict(help="The numbers of the state shown, by name; None where there is none now.").tag(sync=True)

    @traitlets.default("library")
    def _default_library(self) -> Library:
        return Library.shared()

    @property
    def record(self) -> dict:
        """Parameters and readouts of the state shown, flat: a row for ``pandas.DataFrame([figure.record])``."""
        return {**{name: getattr(self, name) for name in self._parameters}, **self.readouts}

    def play(self) -> None:
        """Plays on; from the start where it is at its end."""
        self.send({"do": "play"})

    def pause(self) -> None:
        """Stops at the step shown."""
        self.send({"do": "pause"})

    def reset(self) -> None:
        """Back to the parameters that the notebook gave."""
        self.send({"do": "reset"})
