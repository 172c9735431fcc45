"""The package for colcon."""

from setuptools import setup

setup(
    name="cqltl_robot",
    version="0.2.0",
    packages=["cqltl_robot"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/cqltl_robot"]),
        ("share/cqltl_robot", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    entry_points={"console_scripts": ["follow = cqltl_robot.node:main"]},
)
