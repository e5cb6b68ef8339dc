"""What all figures have in common."""

from __future__ import annotations

import pathlib

import anywidget
import traitlets

from ._options import Options


class Figure(anywidget.AnyWidget, Options):
    """A live figure. Its parameters are traits, in step with the figure in both directions."""

    _esm = pathlib.Path(__file__).parent / "static" / "fastslam-anywidget.js"
    _parameters: tuple[str, ...] = ()

    readouts = traitlets.Dict(help="The numbers of the state shown, by name; None where there is none now.").tag(sync=True)

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
