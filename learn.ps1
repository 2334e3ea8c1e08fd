# What ./learn is on Windows: finds a compiler, CMake and Ninja, builds the tutor (tools/tutor), and runs it.
$root = $PSScriptRoot -replace '\\', '/'
$build = "$root/build/release"
$log = "$root/build/learn.log"

function Fail([int] $code, [string] $text) {
    [Console]::Error.WriteLine("learn: $text")
    exit $code
}

function Has([string] $program) { [bool] (Get-Command $program -CommandType Application -ErrorAction SilentlyContinue) }

# Visual Studio keeps its clang, CMake and Ninja out of PATH; its own shell has them.
function Enter-VisualStudio {
    $finder = "${env:ProgramFiles(x86)}\Microsoft Visual Studio\Installer\vswhere.exe"
    if (-not (Test-Path -LiteralPath $finder)) { return }
    $studio = & $finder -latest -products * -requires Microsoft.VisualStudio.Component.VC.Llvm.Clang -property installationPath
    if (-not $studio) { return }
    Import-Module "$studio\Common7\Tools\Microsoft.VisualStudio.DevShell.dll"
    Enter-VsDevShell -VsInstallPath $studio -SkipAutomaticLocation -DevCmdArguments '-arch=x64' | Out-Null
}

# Sets CXX to a compiler that takes GCC's options: clang++ or g++, but not cl or clang-cl.
function Set-Compiler {
    if ($env:CXX -and (Has $env:CXX)) { return }
    foreach ($compiler in 'clang++', 'g++') {
        if (Has $compiler) {
            $env:CXX = $compiler
            return
        }
    }
    $env:CXX = ''
}

function Build-Tutor {
    New-Item -ItemType Directory -Force $build | Out-Null
    if (-not (Test-Path -LiteralPath "$build/bin/tutor.exe")) { Write-Host 'building the tutor and what all checks need (once, some minutes) ...' }
    if (-not (Test-Path -LiteralPath "$build/build.ninja")) {
        cmake --preset release -S $root *> $log
        if ($LASTEXITCODE -ne 0) {
            Get-Content -LiteralPath $log -Tail 30 | Out-Host
            Fail 1 "CMake failed; its last lines are above, all of them in $log"
        }
    }
    cmake --build $build --target tutor common test_main *> $log
    if ($LASTEXITCODE -ne 0) {
        Get-Content -LiteralPath $log -Tail 30 | Out-Host
        Fail 1 "the build failed; its last lines are above, all of them in $log; if that does not help, remove $build"
    }
}

if ($args.Count -eq 0 -or $args[0] -in '-h', '--help', 'help') {
    Get-Content -Encoding UTF8 -LiteralPath "$root/tools/tutor/usage.txt"
    exit 0
}
Set-Compiler
if (-not $env:CXX -or -not (Has 'cmake') -or -not (Has 'ninja')) {
    Enter-VisualStudio
    Set-Compiler
}
$missing = @('cmake', 'ninja', 'git' | Where-Object { -not (Has $_) })
if (-not $env:CXX) { $missing = @('clang++ or g++') + $missing }
if ($missing) { Fail 2 "missing: $($missing -join ', '); docs/setup.md says how to install them" }
if ($args[0] -eq 'setup') {
    Write-Host "found $env:CXX, CMake, Ninja and Git; CMake fetches the libraries"
    exit 0
}
if ($root -match '[#;"]') { Fail 2 "CMake cannot build in a folder with # ; or a quote in its name; move or rename $root" }
Build-Tutor
& "$build/bin/tutor.exe" --root $root @args
exit $LASTEXITCODE
