"""Reports as text, files and pictures: pure functions of a Report, which write nothing."""
