"""What is wrong with a shader, said where it is found and told by whoever asked."""

from __future__ import annotations


class Complaint(Exception):
    """One sentence for the shader's author; `placed` if it begins with a file and a line."""

    def __init__(self, sentence: str, placed: bool = False) -> None:
        super().__init__(sentence)
        self.placed = placed

    def told(self, path: str) -> str:
        """The sentence with the file in front."""
        sentence = str(self)
        if self.placed:
            return sentence
        return f"{path}{',' if sentence.startswith(('line ', 'key ')) else ':'} {sentence}"
